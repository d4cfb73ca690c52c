#pragma once

#include <cmath>
#include <limits>

#include <plexway/solid/detail/tet_record.hpp>

#include "labels/solid/solid_label.hpp"
#include "labels/solid/solid_sight.hpp"

namespace plexway {

#include "kernel/text_begin.inl"

/// The path that a label of a solid describes: the text of solid_paths.inl, which shaders compile
/// as well.
template <class Real>
class SolidPaths : protected kernel::SolidSight<Real> {
 protected:
  using Sight = kernel::SolidSight<Real>;
  using Sight::bend_point, Sight::from_edge, Sight::parallel, Sight::point_on, Sight::presses;
  using typename Sight::FromEdge;

 public:
  using Label = SolidLabel<Real>;
  using Point = Vector3<Real>;
  using Edge = ReflexEdge<Real>;

  SolidPaths(const Edge* reflex, Index own_edges) : reflex_(reflex), own_edges_(own_edges) {}

  static constexpr int label_bends = Label::bends;
  static constexpr Index unfolded_door = SolidDoor::unfolded;
  static constexpr Index beside_door = SolidDoor::beside;
  [[nodiscard, gnu::always_inline]] const Edge& reflex_edge(Index edge) const {
    return reflex_[edge];
  }
  [[nodiscard]] Index own_edges() const { return own_edges_; }
  static Real abs(Real x) { return std::abs(x); }
  static Real max(Real a, Real b) { return a < b ? b : a; }
  static int max(int a, int b) { return a < b ? b : a; }
  static Real min(Real a, Real b) { return b < a ? b : a; }
  static Real sqrt(Real x) { return std::sqrt(x); }
  static Real clamp(Real x, Real a, Real b) { return kernel::clamp(x, a, b); }
#include "labels/solid/solid_paths.inl"

 protected:
  const Edge* reflex_;
  Index own_edges_;  // edges from here on are further ones, which only bend paths
};

#include "kernel/text_end.inl"

}  // namespace plexway
