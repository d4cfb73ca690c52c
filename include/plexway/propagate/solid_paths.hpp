#pragma once

#include <cmath>
#include <limits>

#include <plexway/complex/tet_record.hpp>
#include <plexway/propagate/solid_label.hpp>
#include <plexway/propagate/solid_sight.hpp>

namespace plexway {

#include <plexway/kernel/text_begin.inl>

/// The path that a label of a solid describes: the text of solid_paths.inl, which shaders compile
/// as well.
template <class Real>
class SolidPaths : protected kernel::SolidSight<Real> {
 protected:
  using Sight = kernel::SolidSight<Real>;
  using Sight::bend_point, Sight::from_edge, Sight::hides_point, Sight::lights, Sight::parallel,
      Sight::point_on, Sight::see_edge, Sight::way_over;
  using typename Sight::Crossing, typename Sight::EdgeSight, typename Sight::FromEdge,
      typename Sight::WayOver;

 public:
  using Label = SolidLabel<Real>;
  using Point = Vector3<Real>;
  using Edge = ReflexEdge<Real>;

  explicit SolidPaths(const Edge* reflex) : reflex_(reflex) {}

  static constexpr int label_limits = Label::limits;
  [[nodiscard, gnu::always_inline]] const Edge& reflex_edge(Index edge) const {
    return reflex_[edge];
  }
  static constexpr Index bent_path(Index path, Index edge) { return SolidPath::bent(path, edge); }
  static constexpr Index path_before(Index path, Index edge) {
    return SolidPath::before(path, edge);
  }
#include <plexway/propagate/solid_paths.inl>

  /// The path with what hides q.
  [[nodiscard]] Reach measure(const Label& label, const Point& q) const {
    return measure(label, q, reach(label, q), std::numeric_limits<Real>::infinity());
  }

  /// A name for a virtual source that has none by the bends that led to it: its place.
  static Index name_of(const Point& at, Real sigma) {
    Index name = 0;
    for (const Real x : {at.x, at.y, at.z, sigma})
      name = SolidPath::bent(name, static_cast<Index>(std::llround(x * Real(4096))));
    return name == 0 ? 1 : name;
  }

 protected:
  const Edge* reflex_;
};

#include <plexway/kernel/text_end.inl>

}  // namespace plexway
