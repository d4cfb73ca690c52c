#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

#include <plexway/complex/tet_record.hpp>
#include <plexway/propagate/solid_label.hpp>

namespace plexway {

/// Relative rounding that decisions must survive.
template <class Real>
inline constexpr Real solid_rounding = 64 * std::numeric_limits<Real>::epsilon();

/// A point, or the eye, from a reflex edge: how far along its line, and how far off it.
template <class Real>
struct FromEdge {
  Real along, off;
  [[gnu::always_inline]] FromEdge(const ReflexEdge<Real>& e, const Vector3<Real>& p) {
    const Vector3<Real> a = p - e.end[0];
    along = dot(a, e.direction);
    off = norm(a - along * e.direction);
  }
  FromEdge(Real x, Real h) : along(x), off(h) {}
};

/// Where the unfolded line from p to q crosses an edge, as a distance from its first end that may
/// lie outside of the edge.
template <class Real>
[[gnu::always_inline]] inline Real crossing_along(const FromEdge<Real>& p,
                                                  const FromEdge<Real>& q) {
  const Real sum = p.off + q.off;
  if (!(sum > 0)) [[unlikely]]
    return p.along;
  return (p.along * q.off + q.along * p.off) / sum;
}

/// The point at a distance along an edge, or the nearer end.
template <class Real>
[[gnu::always_inline]] inline Vector3<Real> point_on(const ReflexEdge<Real>& e, Real along) {
  return e.end[0] + std::clamp(along, Real(0), e.length) * e.direction;
}

/// The shortest way from p to q over an edge.
template <class Real>
struct WayOver {
  Vector3<Real> bend;
  Real length;
};
/// Unfolds q about the edge's line until it lies opposite p, and draws a straight line; or bends at
/// an end.
template <class Real>
[[gnu::always_inline]] inline WayOver<Real> way_over(const ReflexEdge<Real>& e,
                                                     const FromEdge<Real>& from,
                                                     const Vector3<Real>& q) {
  const FromEdge<Real> to(e, q);
  const Real x = crossing_along(from, to);
  if (x >= 0 && x <= e.length) [[likely]] {
    const Real along = to.along - from.along, off = to.off + from.off;
    return {e.end[0] + x * e.direction, std::sqrt(along * along + off * off)};
  }
  const Real end = x < 0 ? 0 : e.length;
  const Real xp = end - from.along, xq = end - to.along;
  return {e.end[0] + end * e.direction,
          std::sqrt(xp * xp + from.off * from.off) + std::sqrt(xq * xq + to.off * to.off)};
}
/// The bend alone.
template <class Real>
[[gnu::always_inline]] inline Vector3<Real> bend_point(const ReflexEdge<Real>& e,
                                                       const Vector3<Real>& p,
                                                       const Vector3<Real>& q) {
  const FromEdge<Real> from(e, p), to(e, q);
  return point_on(e, crossing_along(from, to));
}
/// The same for any segment.
template <class Real>
Vector3<Real> bend_point(const Vector3<Real>& a, const Vector3<Real>& b, const Vector3<Real>& p,
                         const Vector3<Real>& q) {
  ReflexEdge<Real> edge{};
  edge.end[0] = a;
  edge.length = norm(b - a);
  if (!(edge.length > 0)) return a;
  edge.direction = 1 / edge.length * (b - a);
  return bend_point(edge, p, q);
}

/// A reflex edge seen from a point: what it hides.
template <class Real>
class EdgeView {
 public:
  [[gnu::always_inline]] EdgeView(const ReflexEdge<Real>& edge, const Vector3<Real>& eye)
      : edge_(edge),
        eye_(eye),
        a_(edge.end[0] - eye),
        n_(cross(a_, edge.direction)),
        solid_(dot(n_, edge.solid)) {}

  /// Not in its shadow, by more than a small angle (squared).
  [[nodiscard]] bool lights(const Vector3<Real>& q, Real angle2) const {
    const Vector3<Real> g = q - eye_;
    const Real h = solid_ < 0 ? -dot(n_, g) : dot(n_, g);
    return h > 0 && h * h > angle2 * dot(n_, n_) * dot(g, g);
  }

  /// Is q in its shadow? `slack`: how far beyond its ends it still hides, in its own lengths.
  /// Most edges do not hide a point, and most of those because it lies on their bright side.
  [[nodiscard, gnu::always_inline]] bool hides(const Vector3<Real>& q, Real slack) const {
    Crossing unused;
    return hides(q, slack, unused);
  }
  /// Says also where the path would bend, as a distance from the first end: times / sum.
  struct Crossing {
    Real times, sum;
  };
  [[nodiscard, gnu::always_inline]] bool hides(const Vector3<Real>& q, Real slack,
                                               Crossing& crossing) const {
    const Vector3<Real> g = q - eye_;
    const Real h = dot(n_, g);
    if (solid_ * h >= 0) [[likely]]
      return false;
    const Real nn = dot(n_, n_);
    if (!can_hide(nn)) return false;
    const FromEdge<Real> eye(dot(a_, edge_.direction) * Real(-1), std::sqrt(nn)), there(edge_, q);
    const Real x = eye.along * there.off + there.along * eye.off, sum = eye.off + there.off;
    const Real most = slack * edge_.length * sum;
    if (!(x >= -most && x - edge_.length * sum <= most)) return false;
    crossing = {x, sum};
    return behind(q, g, h, nn, eye.along);
  }

  struct Rank {
    Real closeness;  ///< how closely the line of sight passes it: an angle, squared
    bool dark;       ///< as `hides` says
  };
  /// infinity: it can hide nothing, or does not hide q and is no closer than `worst`.
  [[nodiscard]] Rank rank(const Vector3<Real>& q, Real slack, Real worst) const {
    const Vector3<Real> g = q - eye_;
    const Real h = dot(n_, g), nn = dot(n_, n_), sine2 = h * h / (nn * dot(g, g));
    if ((solid_ * h >= 0 && sine2 >= worst) || !can_hide(nn))
      return {std::numeric_limits<Real>::infinity(), false};
    const FromEdge<Real> eye(dot(a_, edge_.direction) * Real(-1), std::sqrt(nn)), there(edge_, q);
    const Real x = crossing_along(eye, there);
    const Real beyond = std::max(std::max(-x, x - edge_.length), Real(0));
    const Vector3<Real> b = edge_.end[1] - eye_;
    return {sine2 + beyond * beyond / std::min(dot(a_, a_), dot(b, b)),
            solid_ * h < 0 && beyond <= slack * edge_.length && behind(q, g, h, nn, eye.along)};
  }

 private:
  static constexpr Real tiny = solid_rounding<Real>;

  /// Not end on; an eye in front of both sides of the edge has nothing hidden from it; well behind
  /// both it does not see the edge, unless that is almost flat.
  [[nodiscard, gnu::always_inline]] bool can_hide(Real nn) const {
    if (!(nn > tiny * tiny * dot(a_, a_))) return false;
    const Real s0 = dot(a_, edge_.normal[0]), s1 = dot(a_, edge_.normal[1]);
    if (std::max(s0, s1) < 0) return false;
    return std::min(s0, s1) <= 1024 * tiny || dot(edge_.normal[0], edge_.normal[1]) >= Real(0.5);
  }

  /// Does q, on the dark side, come out behind the obstacle? Else it may be before it, or on
  /// another side of it.
  [[nodiscard, gnu::always_inline]] bool behind(const Vector3<Real>& q, const Vector3<Real>& g,
                                                Real h, Real nn, Real eye_along) const {
    if (!(h * h > tiny * tiny * nn * dot(g, g))) return false;
    const Vector3<Real> aq = q - edge_.end[0];
    const Real q0 = dot(aq, edge_.normal[0]), q1 = dot(aq, edge_.normal[1]);
    const bool first = dot(a_, edge_.normal[0]) < dot(a_, edge_.normal[1]);  // faces the eye
    const Real front = first ? q0 : q1, back = first ? q1 : q0;
    if (back <= tiny && front >= -tiny) return false;
    return !(back < -tiny) || dot(aq, a_ + eye_along * edge_.direction) > 0;
  }

  const ReflexEdge<Real>& edge_;
  const Vector3<Real>& eye_;
  Vector3<Real> a_, n_;
  Real solid_;  // n's side: > 0 towards the solid
};

/// Does the line from `eye` to q, on the other side, pass triangle (a, b, c)? Give or take
/// `tolerance` in each barycentric coordinate. Seen from q the triangle runs anticlockwise.
template <class Real>
bool passes(const Vector3<Real>& eye, const Vector3<Real>& q, const Vector3<Real>& a,
            const Vector3<Real>& b, const Vector3<Real>& c, Real tolerance) {
  const Vector3<Real> g = q - eye, u = a - eye, v = b - eye, w = c - eye;
  const Vector3<Real> gu = cross(g, u), gv = cross(g, v);
  const Real wc = dot(gu, v), wa = dot(gv, w), wb = -dot(gu, w);
  const Real sum = wa + wb + wc;
  const Real least = std::min(std::min(wa, wb), wc);
  // On our side of the plane, give or take rounding.
  const Real height = dot(u, cross(b - a, c - a));
  const Real scale = std::abs(sum) + std::abs(height);
  return sum > 0 && least >= -tolerance * sum && height >= -solid_rounding<Real> * scale;
}

/// Where the segment from `eye` to q crosses the plane of a, b, c, or the end nearest to it.
template <class Real>
Vector3<Real> plane_crossing(const Vector3<Real>& eye, const Vector3<Real>& q,
                             const Vector3<Real>& a, const Vector3<Real>& b,
                             const Vector3<Real>& c) {
  const Vector3<Real> normal = cross(b - a, c - a);
  const Real from = dot(normal, eye - a), to = dot(normal, q - a);
  const Real share = from == to ? Real(0.5) : std::clamp(from / (from - to), Real(0), Real(1));
  return eye + share * (q - eye);
}

}  // namespace plexway
