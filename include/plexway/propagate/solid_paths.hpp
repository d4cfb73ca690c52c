#pragma once

#include <cmath>
#include <limits>

#include <plexway/complex/tet_record.hpp>
#include <plexway/propagate/solid_label.hpp>
#include <plexway/propagate/solid_sight.hpp>

namespace plexway {

/// The path that a label of a solid describes: from the virtual source, over its ring, around the
/// edges it remembers, to a point.
template <class Real>
class SolidPaths {
 public:
  using Label = SolidLabel<Real>;
  using Point = Vector3<Real>;

  explicit SolidPaths(const ReflexEdge<Real>* reflex) : reflex_(reflex) {}

  struct Reach {
    Point eye;  // the last bend
    Real length;
    int bend = -1;  // at this limit
  };

  /// The path as the label has it, limits aside.
  [[nodiscard, gnu::always_inline]] Reach reach(const Label& label, const Point& q) const {
    if (label.ring == none) return {label.source, label.sigma + norm(q - label.source), -1};
    return reach(label, before_ring(label), q);
  }
  /// Where S is from the ring: the same for all q.
  [[nodiscard, gnu::always_inline]] FromEdge<Real> before_ring(const Label& label) const {
    if (label.ring == none) return {0, 0};
    return FromEdge<Real>(reflex_[label.ring], label.source);
  }
  [[nodiscard, gnu::always_inline]] Reach reach(const Label& label, const FromEdge<Real>& before,
                                                const Point& q) const {
    if (label.ring == none) return {label.source, label.sigma + norm(q - label.source), -1};
    const WayOver<Real> way = way_over(reflex_[label.ring], before, q);
    return {way.bend, label.sigma + way.length, -1};
  }

  /// The same with bends at one limit, or at two in a row: relaxed once, which is exact for a
  /// single bend after a point and never too short.
  [[nodiscard]] Reach reach_by(const Label& label, const Point& eye, int limit,
                               const Point& q) const {
    const Point b = bend_point(reflex_[label.limit[limit]], eye, q);
    return {b, way_to(label, b) + norm(q - b), limit};
  }
  [[nodiscard]] Reach reach_by(const Label& label, const Point& eye, int first, int second,
                               const Point& q) const {
    const ReflexEdge<Real>& one = reflex_[label.limit[first]];
    const ReflexEdge<Real>& two = reflex_[label.limit[second]];
    Point c = bend_point(two, bend_point(one, eye, q), q);
    const Point b = bend_point(one, eye, c);
    c = bend_point(two, b, q);
    return {c, way_to(label, b) + norm(c - b) + norm(q - c), first};
  }
  [[nodiscard]] Real way_to(const Label& label, const Point& q) const {
    return reach(label, q).length;
  }

  [[nodiscard, gnu::always_inline]] bool hides(Index edge, const Point& eye, const Point& q) const {
    return EdgeView<Real>(reflex_[edge], eye).hides(q, slack);
  }

  /// The path with what hides q. At `known` or more it need not be exact: it is longer yet.
  [[nodiscard]] Reach measure(const Label& label, const Point& q) const {
    return measure(label, q, reach(label, q));
  }
  [[nodiscard]] Reach measure(const Label& label, const Point& q, const Reach& straight,
                              Real known = std::numeric_limits<Real>::infinity()) const {
    typename EdgeView<Real>::Crossing crossing[Label::limits];
    int dark[Label::limits];
    int count = 0;
    for (int k = 0; k < Label::limits && label.limit[k] != none; ++k)
      if (EdgeView<Real>(reflex_[label.limit[k]], straight.eye).hides(q, slack, crossing[count]))
        dark[count++] = k;
    if (count == 0) return straight;
    const FromEdge<Real> before = before_ring(label);
    Reach bent = straight;
    for (int i = 0; i < count; ++i) {
      const Point b = point_on(reflex_[label.limit[dark[i]]], crossing[i].times / crossing[i].sum);
      const Real length = reach(label, before, b).length + norm(q - b);
      if (length > bent.length || bent.bend < 0) bent = {b, length, dark[i]};
      if (!(length < known)) return bent;
    }
    const int k = bent.bend;
    // The way to the bend may be hidden itself, or the way on.
    const Reach one = bent;
    for (int j = 0; j < Label::limits && label.limit[j] != none; ++j) {
      if (j == k) continue;
      Reach both = one;
      if (hides(label.limit[j], straight.eye, one.eye))
        both = reach_by(label, straight.eye, j, k, q);
      else if (hides(label.limit[j], one.eye, q))
        both = reach_by(label, straight.eye, k, j, q);
      if (both.length > bent.length) bent = both;
    }
    return bent;
  }

  /// Bends at a limit for good.
  void turn(Label& label, int limit, const Point& q) const {
    const Index edge = label.limit[limit];
    if (label.ring != none) {
      // If the edges are parallel, S turns about the old ring until it lies in line with the way to
      // the new one: exact. Else the bend becomes the source.
      const ReflexEdge<Real>& ring = reflex_[label.ring];
      const Point c = reach_by(label, reach(label, q).eye, limit, q).eye;
      const Point b = bend_point(ring, label.source, c);
      const Real walked = norm(b - label.source), on = norm(c - b);
      const Real at = dot(b - ring.end[0], ring.direction);
      const bool parallel = std::abs(dot(ring.direction, reflex_[edge].direction)) > Real(1 - 1e-6);
      if (parallel && at > 0 && at < ring.length && on > 0) {
        label.source = b + walked / on * (b - c);
      } else {
        label.sigma += walked;
        label.source = b;
      }
    }
    label.path = SolidPath::bent(label.path, edge);
    label.ring = edge;
    for (int k = limit; k + 1 < Label::limits; ++k) label.limit[k] = label.limit[k + 1];
    label.limit[Label::limits - 1] = none;
  }

  static void clear_limits(Label& label) {
    for (Index& limit : label.limit) limit = none;
  }

  [[nodiscard]] bool hides_all(Index edge, const Point& eye, const Point& a, const Point& b,
                               const Point& c) const {
    const EdgeView<Real> view(reflex_[edge], eye);
    constexpr Real small = Real(1e-8);
    return !view.lights(a, small) && !view.lights(b, small) && !view.lights(c, small);
  }

  /// A name for a virtual source that has none by the bends that led to it: its place.
  static Index name_of(const Point& at, Real sigma) {
    Index name = 0;
    for (const Real x : {at.x, at.y, at.z, sigma})
      name = SolidPath::bent(name, static_cast<Index>(std::llround(x * Real(4096))));
    return name == 0 ? 1 : name;
  }

  static constexpr Real slack = Real(0.5);  ///< so far beyond its ends an edge hides, in its length

 protected:
  const ReflexEdge<Real>* reflex_;
};

}  // namespace plexway
