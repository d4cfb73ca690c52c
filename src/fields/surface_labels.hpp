#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <optional>
#include <span>

#include <plexway/fields/read_out.hpp>
#include <plexway/surface/triangle_mesh.hpp>

#include "complexes/common/geometry.hpp"
#include "fields/window_read_out.hpp"
#include "labels/plain_rule.hpp"
#include "labels/surface/saddle_rule.hpp"
#include "paths/solved.hpp"

namespace plexway::detail {

/// The labels a propagation left on a surface, as its rule reads them: a front that nothing waits
/// in.
template <class Real, class Label>
class LeftLabels {
 public:
  LeftLabels(const VisitMarks& marks, const Label* labels) : marks_(marks), labels_(labels) {}
  [[nodiscard]] bool reached(Index s) const { return marks_.reached(s); }
  [[nodiscard]] std::size_t hinge(Index s) const { return marks_.hinge(s); }
  [[nodiscard]] const Label& label(Index s) const { return labels_[s]; }
  void put(Index, const Label&) {}

 private:
  const VisitMarks& marks_;
  const Label* labels_;
};

/// Those of either rule.
template <class Real>
class SurfaceLabels {
 public:
  using Posed = PosedSaddles<double>;
  using Point = Posed::Point;

  SurfaceLabels(const TriangleMesh<Real>& mesh, const Solved<Real>& solved)
      : mesh_(mesh), solved_(solved), saddles_(solved.visibility == Visibility::saddles) {}

  [[nodiscard]] bool reached(Index f) const { return solved_.workspace.marks.reached(f); }
  /// The edge that the label came in by.
  [[nodiscard]] std::size_t hinge(Index f) const { return solved_.workspace.marks.hinge(f); }

  /// Length of the label's path to corner i, in the unit inside.
  [[nodiscard]] double corner_distance(Index f, std::size_t i) const {
    return ask([&](const auto& rule) { return static_cast<double>(rule.corner_distance(f, i)); });
  }

  /// What the label's path to a point q of f looks like from there. In a plane with the edge it
  /// came in by on the x axis, first corner at 0, and f above. Unit inside.
  struct Sight {
    Vector2 source;  ///< the virtual source
    Vector2 bend;    ///< the last bend before q, or the virtual source again
  };
  [[nodiscard]] Vector2 virtual_source(Index f) const {
    if (saddles_) {
      const auto& label = solved_.workspace.saddles.labels[f];
      return {static_cast<double>(label.x[0]), -static_cast<double>(label.h[0])};
    }
    const double length = static_cast<double>(mesh_.triangles()[f].length[hinge(f)]);
    const auto& label = solved_.workspace.simplex.template labels<2>()[f];
    const double d0 = static_cast<double>(label.distance2[hinge(f)]);
    const double d1 = static_cast<double>(label.distance2[edge_after(hinge(f))]);
    const double x = length > 0 ? (d0 - d1 + length * length) / (2 * length) : 0;
    return {x, -std::sqrt(std::max(d0 - x * x, 0.))};
  }
  /// The whole label, with saddles.
  [[nodiscard]] Posed posed(Index f) const {
    const SaddleLabel<Real>& label = solved_.workspace.saddles.labels[f];
    const auto number = [](Real x) { return static_cast<double>(x); };
    Posed p;
    p.source = {{number(label.x[0])}, number(label.h[0])};
    for (int side = 0; side < 2; ++side)  // kept as offsets
      p.limit[side] = {{p.source.x[0] + number(label.x[2 + side])},
                       p.source.h + number(label.h[2 + side])};
    p.sigma = number(label.sigma());
    return p;
  }
  /// Edge k of f, for a label that comes in by it.
  [[nodiscard]] SaddleHinge<double> hinge_of(Index f, std::size_t k, int pivot) const {
    using Rule = SaddleRule<Real, LeftLabels<Real, SaddleLabel<Real>>>;
    return Rule::template hinge_of<double>(mesh_.triangles()[f], k, pivot);
  }
  /// The way to the virtual source, with saddles.
  [[nodiscard]] double sigma(Index f) const {
    return static_cast<double>(solved_.workspace.saddles.labels[f].x[1]);
  }
  [[nodiscard]] Sight sight(Index f, const Vector2& q) const {
    const Vector2 source = virtual_source(f);
    if (!saddles_) return {source, source};
    const Posed label = posed(f);
    Point from = label.source;
    const Point(&limit)[2] = label.limit;
    const Point to = {{q.x}, q.y};
    const TriangleRecord<Real>& t = mesh_.triangles()[f];
    const double length = static_cast<double>(t.length[hinge(f)]);
    const double slack =  // as rounding of labels leaves it
        1e-4 * static_cast<double>(std::max({t.length[0], t.length[1], t.length[2]}));
    // A bend at q itself is none.
    const auto elsewhere = [&](const Vector2& at) { return norm(at - q) > slack; };
    const auto in_plane = [](const Point& p) { return Vector2{p.x[0], -p.h}; };
    if (left_of<double>(from, limit[0], to) > 0 && elsewhere(in_plane(limit[0])))
      from = limit[0];
    else if (left_of<double>(from, limit[1], to) < 0 && elsewhere(in_plane(limit[1])))
      from = limit[1];
    const double sum = from.h + to.h;
    const double crossing = sum > 0 ? (from.x[0] * to.h + to.x[0] * from.h) / sum : from.x[0];
    Vector2 bend = in_plane(from);
    if (from.h >= 0 && crossing < -slack && elsewhere({0, 0})) bend = {0, 0};
    if (from.h >= 0 && crossing > length + slack && elsewhere({length, 0})) bend = {length, 0};
    return {source, bend};
  }

 private:
  template <class Ask>
  double ask(Ask question) const {
    const WorkspaceState<Real>& w = solved_.workspace;
    if (saddles_) {
      LeftLabels<Real, SaddleLabel<Real>> left(w.marks, w.saddles.labels.get());
      return question(SaddleRule<Real, decltype(left)>(mesh_.triangles(), left, false));
    }
    LeftLabels<Real, SimplexLabel<Real, 2>> left(w.marks, w.simplex.template labels<2>());
    // Any table will do: it makes no offers, and so aims at nothing.
    return question(PlainRule<Real, decltype(left)>(mesh_.triangles(), left, solved_.visibility,
                                                    ProbeTable::learned()));
  }

  const TriangleMesh<Real>& mesh_;
  const Solved<Real>& solved_;
  bool saddles_;
};

/// Distances of points inside triangles, from the labels that Visibility::saddles left. Numbers and
/// unit inside, arithmetic in double.
template <class Real>
class SurfaceReadOut {
 public:
  using Posed = typename SurfaceLabels<Real>::Posed;
  using Point = typename Posed::Point;

  SurfaceReadOut(const TriangleMesh<Real>& mesh, const Solved<Real>& solved)
      : mesh_(mesh), triangles_(mesh.triangles()), solved_(solved), labels_(mesh, solved) {
    if (solved.windows) windows_.emplace(mesh, solved);
  }

  [[nodiscard]] double at(Index f, const std::array<double, 3>& weight, ReadOut level) const;
  /// Where the straight line from a point of f, not on the rim, back to the source leads: a place
  /// in f, which is the point itself where the source is there. Nothing where unreachable.
  [[nodiscard]] std::optional<std::array<double, 3>> towards(
      Index f, const std::array<double, 3>& weight) const;

 private:
  struct Step {  // from one triangle over its edge `out` to the next, whose edge is `in`
    Index from;
    std::size_t out, in;
    Index to;
    bool flip;
  };
  [[nodiscard]] bool step_over(Index f, std::size_t edge, Step& step) const;
  [[nodiscard]] Point point_over(Index f, std::size_t edge,
                                 const std::array<double, 3>& weight) const;
  [[nodiscard]] Posed turned(Index f, const Posed& label, std::size_t from, std::size_t to,
                             int& pivot) const;
  [[nodiscard]] double own(Index f, const std::array<double, 3>& weight) const;
  [[nodiscard]] double from_where_it_came(const Step& step, const Point& q) const;
  [[nodiscard]] double offered(const Step* steps, int count, const Point& q) const;

  const TriangleMesh<Real>& mesh_;
  std::span<const TriangleRecord<Real>> triangles_;
  const Solved<Real>& solved_;
  SurfaceLabels<Real> labels_;
  std::optional<WindowReadOut<Real>> windows_;
};

extern template class SurfaceReadOut<float>;
extern template class SurfaceReadOut<double>;

}  // namespace plexway::detail
