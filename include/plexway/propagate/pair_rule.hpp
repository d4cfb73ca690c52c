#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
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
/// changes. (1) Locality, see PointPairs; half as much at a boundary. (2) A line that misses the
/// hinge by up to its length goes on straight where it passes a point that is on no boundary: a
/// bend there is no shortest path, and bends add up. (3) No point is farther than a neighbour and
/// the way between: where no hinge offers that, the path bends at the neighbour (a hinge with K =
/// 0).
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
    if (labels_[c].a2 == 0 || labels_[c].b2 == 0) mend(c);
    const Label label = labels_[c];
    const Index source = front_.source(c);
    Side sides[2];
    int count = 0;
    if (label.a != none) sides[count++] = side(c, label.a, label.b, label, label.a2, label.b2);
    if (label.b != none) sides[count++] = side(c, label.b, label.a, label, label.b2, label.a2);
    for (Index k = begin_[c]; k < begin_[c + 1]; k += batch)
      expand(c, label, source, std::span<const Side>(sides, static_cast<std::size_t>(count)), k,
             std::min(begin_[c + 1], k + batch));
  }

 private:
  static constexpr Real gain = Real(1e-4);  // units; less is no gain: it may be rounding
  // Triangles with a corner on a boundary reach half as far, lest they cut an obstacle's corners.
  static constexpr Real near_boundary = Real(.25);

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

  struct Candidate {
    Index x;
    Real c2, q2;  // squared distances from the ends of the hinge
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

  static constexpr Real worth_mending = Real(.1);
  static constexpr Index batch = 32;

  /// The path to x has just bent at another point. If two of its neighbours see the same source,
  /// over the edge between them it may be straight, though neither came to offer that.
  void mend(Index x) {
    struct Seen {
      Index c;
      Real d, sigma, x2;
    };
    Seen seen[batch];
    std::size_t count = 0;
    const Real here = distance_[x], reach2 = std::abs(places_[x].reach2);
    const Index last = std::min(begin_[x + 1], begin_[x] + batch);
    for (Index k = begin_[x]; k < last; ++k) {
      const Index c = neighbours_[k];
      if (!(distance_[c] < here) || front_.source(c) != front_.source(x)) continue;
      const Vector to = between(x, c);
      seen[count++] = {c, distance_[c] - labels_[c].sigma, labels_[c].sigma, dot(to, to)};
    }
    Real best = here - worth_mending;
    Label label = labels_[x];
    for (std::size_t i = 0; i < count; ++i)
      for (std::size_t j = 0; j < i; ++j) {
        if (seen[i].sigma != seen[j].sigma) continue;
        const Vector along = between(seen[i].c, seen[j].c);
        const Real edge2[1] = {dot(along, along)};
        if (edge2[0] > reach2) continue;
        const auto pose = Kernel::make_pose(edge2);
        const Real s2[2] = {seen[i].d * seen[i].d, seen[j].d * seen[j].d};
        const Real x2[2] = {seen[i].x2, seen[j].x2};
        const Point S = Kernel::locate(pose, s2), X = Kernel::locate(pose, x2);
        const Real straight2 = Kernel::distance_squared(pose, S, X);
        const Real straight = seen[i].sigma + std::sqrt(straight2);
        if (!(straight < best) || !Kernel::inside(pose, Kernel::crossing(S, X), Real(0))) continue;
        best = straight;
        label = {seen[i].c, seen[j].c, s2[0], s2[1], straight2, seen[i].sigma};
      }
    if (!(best < here - worth_mending)) return;
    distance_[x] = best;
    labels_[x] = label;
  }

  /// To the neighbours from `first` to `last`. What is asked of each of them is a coin toss, so who
  /// passes is written to a list without a branch.
  void expand(Index c, const Label& label, Index source, std::span<const Side> sides, Index first,
              Index last) {
    const PairPlace<Real> at = places_[c];
    const Real here = distance_[c], reach2 = std::abs(at.reach2);
    Index ahead[batch];
    std::size_t count = 0;
    for (Index k = first; k < last; ++k) {
      ahead[count] = neighbours_[k];
      count += distance_[neighbours_[k]] > here;
    }
    Real c2[batch];
    Candidate across[2][batch];
    std::size_t candidates[2] = {0, 0};
    for (std::size_t i = 0; i < count; ++i) {
      const Index x = ahead[i];
      const PairPlace<Real> to = places_[x];
      const Vector d = {to.x - at.x, to.y - at.y, to.z - at.z};
      c2[i] = dot(d, d);
      for (std::size_t s = 0; s < sides.size(); ++s) {
        const Vector e = {to.x - sides[s].end.x, to.y - sides[s].end.y, to.z - sides[s].end.z};
        const Real q2 = dot(e, e);
        across[s][candidates[s]] = {x, c2[i], q2};
        const bool at_boundary = std::min({at.reach2, to.reach2, sides[s].end.reach2}) < 0;
        const bool near = q2 <= (at_boundary ? reach2 * near_boundary : reach2);
        const bool beyond = dot(d, sides[s].inward) <= 0, other = x != sides[s].q;
        candidates[s] += near & beyond & other;
      }
    }
    for (std::size_t s = 0; s < sides.size(); ++s)
      for (std::size_t i = 0; i < candidates[s]; ++i)
        cross(c, sides[s], label, across[s][i], source);
    for (std::size_t i = 0; i < count; ++i) {
      const Real more = distance_[ahead[i]] - here;
      if (more * more > c2[i] * (1 + gain)) [[unlikely]]
        offer(ahead[i], {c, none, 0, 0, c2[i], here}, here + std::sqrt(c2[i]), source);
    }
  }

  /// Over the hinge, to a point behind it.
  void cross(Index c, const Side& side, const Label& label, const Candidate& to, Index source) {
    const Index x = to.x;
    const Real x2[2] = {to.c2, to.q2};
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
    __builtin_prefetch(&neighbours_[begin_[x]]);  // it is expanded soon
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
