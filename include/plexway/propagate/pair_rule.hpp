#pragma once

#include <cmath>
#include <span>

#include <plexway/complex/point_pairs.hpp>
#include <plexway/kernel/hinge.hpp>
#include <plexway/propagate/pair_label.hpp>

namespace plexway {

/// The step on vertex pairs: the K = 1 hinge kernel, word for word, over hinges found when a point
/// is expanded.
///
/// Point c came with a triangle a, b, c. Its hinges are (c, a) and (c, b), and what lies behind one
/// are the neighbours x of c that are farther than c, on the other side of the hinge than the third
/// corner, and near enough to its other end. There is a label for each point, not for each pair:
/// what a point's better label replaces need not be expanded any more.
///
/// The step is that of Trettner, Bommes, Kobbelt (SGP 2021) for point clouds, with three
/// changes. (1) Locality, see PointPairs. (2) A line that misses the hinge by up to its length goes
/// on straight where it passes a point that is on no boundary: a bend there is no shortest path,
/// and bends add up. (3) No point is farther than a neighbour and the way between: where no hinge
/// offers that, the path bends at the neighbour (a hinge with K = 0).
template <class Real, class Front>
class PairRule {
 public:
  using Label = PairLabel<Real>;
  using Kernel = kernel::HingeKernel<Real, 1>;
  using Point = typename Kernel::HingePoint;

  /// `distance`: one a place, infinite where unreached. `slack`: how far a line may miss a hinge,
  /// in its length; 0: paths bend at any point.
  PairRule(const PointPairs<Real>& pairs, Label* labels, Real* distance, Front& front, Real slack)
      : begin_(pairs.begin().data()),
        neighbours_(pairs.neighbours().data()),
        places_(pairs.places().data()),
        labels_(labels),
        distance_(distance),
        front_(front),
        slack_(slack) {}

  [[nodiscard]] Real distance(Index c) const { return distance_[c]; }

  /// A path of length sigma begins at a place.
  void seed(Index c, Real sigma, Index source) {
    if (sigma < distance_[c]) take(c, {none, none, 0, 0, 0, sigma}, sigma, source);
  }

  void expand(Index c) {
    const Label label = labels_[c];
    const Index source = front_.source(c);
    Side sides[2];
    int count = 0;
    if (label.a != none) sides[count++] = side(c, label.a, label.b, label, label.a2, label.b2);
    if (label.b != none) sides[count++] = side(c, label.b, label.a, label, label.b2, label.a2);
    const PairPlace<Real> at = places_[c];
    const Real here = distance_[c], reach2 = std::abs(at.reach2);
    const Index last = begin_[c + 1];
    for (Index k = begin_[c]; k < last; ++k) {
      const Index x = neighbours_[k];
      if (!(distance_[x] > here)) continue;
      const PairPlace<Real> to = places_[x];
      const Vector d = {to.x - at.x, to.y - at.y, to.z - at.z};
      const Real c2 = dot(d, d);
      for (int i = 0; i < count; ++i) {
        if (dot(d, sides[i].inward) > 0) continue;
        const Vector e = {to.x - sides[i].end.x, to.y - sides[i].end.y, to.z - sides[i].end.z};
        const Real q2 = dot(e, e);
        if (q2 <= reach2 && x != sides[i].q) cross(c, sides[i], label, x, c2, q2, source);
      }
      const Real ahead = distance_[x] - here;
      if (ahead * ahead > c2 * (1 + gain)) {
        const Real length = std::sqrt(c2);
        offer(x, {c, none, 0, 0, c2, here}, here + length, source);
      }
    }
  }

 private:
  static constexpr Real gain = Real(1e-4);  // units; less is no gain: it may be rounding

  struct Vector {
    Real x, y, z;
  };
  static Real dot(const Vector& a, const Vector& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
  Vector between(Index a, Index b) const {
    return {places_[b].x - places_[a].x, places_[b].y - places_[a].y, places_[b].z - places_[a].z};
  }

  /// A hinge (c, q), posed, with c as vertex 0.
  struct Side {
    Index q;
    bool behind;    // S lies on the far side already
    Vector inward;  // from the hinge to the third corner, across it; 0 without one
    PairPlace<Real> end;
    Real q2;  // squared distance from S
    Point S;
    typename Kernel::HingePose pose;
  };

  Side side(Index c, Index q, Index third, const Label& label, Real q2, Real third2) const {
    Side s;
    s.q = q;
    s.q2 = q2;
    s.end = places_[q];
    const Vector along = between(c, q);
    const Real edge2[1] = {dot(along, along)};
    s.pose = Kernel::make_pose(edge2);
    const Real s2[2] = {label.c2, q2};
    s.S = Kernel::locate(s.pose, s2);
    s.inward = {0, 0, 0};
    s.behind = false;
    if (third == none) return s;
    const Vector inward = between(c, third), rest = between(q, third);
    const Real u2[2] = {dot(inward, inward), dot(rest, rest)};
    s.behind = Kernel::behind(s.pose, s.S, Kernel::locate(s.pose, u2), third2) > 0;
    const Real share = dot(inward, along) * s.pose.inverse[0];
    s.inward = {inward.x - share * along.x, inward.y - share * along.y, inward.z - share * along.z};
    return s;
  }

  /// Over the hinge to x, at squared distances c2 and q2 from its ends.
  void cross(Index c, const Side& side, const Label& label, Index x, Real c2, Real q2,
             Index source) {
    const Real x2[2] = {c2, q2};
    const Point X = Kernel::locate(side.pose, x2);
    // No bend makes a path shorter: what is not better straight is not looked at further.
    const Real straight2 = Kernel::distance_squared(side.pose, side.S, X);
    const Real straight = label.sigma + std::sqrt(straight2);
    if (!(straight < distance_[x] - gain)) return;
    const auto at = Kernel::crossing(side.S, X);
    bool visible = !side.behind && Kernel::inside(side.pose, at, Real(0));
    if (!visible) {
      const bool first = at.x[0] <= 0;
      if (side.behind) {
        if (!boundary(c) && !boundary(side.q)) return;
      } else if (!boundary(first ? c : side.q)) {
        visible = Kernel::inside(side.pose, at, slack_);
      }
    }
    if (visible) {
      offer(x, {c, side.q, label.c2, side.q2, straight2, label.sigma}, straight, source);
      return;
    }
    const auto bent = Kernel::bend(side.pose, side.S, X);
    const auto from = [&](const Point& v) {
      return Kernel::distance_squared(side.pose, bent.point, v);
    };
    offer(x,
          {c, side.q, from(Kernel::vertex_point(side.pose, 0)),
           from(Kernel::vertex_point(side.pose, 1)), from(X), label.sigma + bent.walked},
          label.sigma + bent.total, source);
  }

  [[nodiscard]] bool boundary(Index c) const {
    return slack_ == 0 || std::signbit(places_[c].reach2);
  }

  void offer(Index x, const Label& label, Real distance, Index source) {
    if (distance < distance_[x] - gain) take(x, label, distance, source);
  }

  void take(Index x, const Label& label, Real distance, Index source) {
    distance_[x] = distance;
    labels_[x] = label;
    front_.accept(x, 0, distance, source);
  }

  const Index* begin_;
  const Index* neighbours_;
  const PairPlace<Real>* places_;
  Label* labels_;
  Real* distance_;
  Front& front_;
  Real slack_;
};

}  // namespace plexway
