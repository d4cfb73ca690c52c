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

/// Where the unfolded line from p to q crosses an edge, as a distance from its first end that may
/// lie outside of the edge. `hp`: p's distance from the edge's line.
template <class Real>
[[gnu::always_inline]] inline Real crossing_along(const ReflexEdge<Real>& e, const Vector3<Real>& p,
                                                  Real hp, const Vector3<Real>& q) {
  const Vector3<Real> ap = p - e.end[0], aq = q - e.end[0];
  const Real xp = dot(ap, e.direction), xq = dot(aq, e.direction);
  const Real hq = norm(aq - xq * e.direction);
  return hp + hq > 0 ? (xp * hq + xq * hp) / (hp + hq) : xp;
}

/// The point of an edge over which p reaches q soonest: unfold q about the edge's line until it
/// lies opposite p, and draw a straight line; or an end.
template <class Real>
Vector3<Real> bend_point(const ReflexEdge<Real>& e, const Vector3<Real>& p,
                         const Vector3<Real>& q) {
  const Vector3<Real> ap = p - e.end[0];
  const Real hp = norm(ap - dot(ap, e.direction) * e.direction);
  const Real x = std::clamp(crossing_along(e, p, hp, q), Real(0), e.length);
  return e.end[0] + x * e.direction;
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

/// Most edges do not hide a point, and most of those because it lies on their bright side.
template <class Real>
[[gnu::always_inline]] inline bool on_bright_side(const ReflexEdge<Real>& edge,
                                                  const Vector3<Real>& eye,
                                                  const Vector3<Real>& q) {
  const Vector3<Real> n = cross(edge.end[0] - eye, edge.direction);
  return dot(n, edge.solid) * dot(n, q - eye) >= 0;
}

/// A reflex edge seen from a point: what it hides.
template <class Real>
class EdgeView {
 public:
  EdgeView(const ReflexEdge<Real>& edge, const Vector3<Real>& eye)
      : edge_(edge), eye_(eye), a_(edge.end[0] - eye), n_(cross(a_, edge.direction)) {
    if (dot(n_, edge.solid) < 0) n_ = Real(-1) * n_;  // to the solid's side
  }

  /// Not in its shadow, by more than a small angle (squared).
  [[nodiscard]] bool lights(const Vector3<Real>& q, Real angle2) const {
    const Vector3<Real> g = q - eye_;
    const Real h = dot(n_, g);
    return h > 0 && h * h > angle2 * dot(n_, n_) * dot(g, g);
  }

  /// Is q in its shadow? `slack`: how far beyond its ends it still hides, in its own lengths.
  [[nodiscard]] bool hides(const Vector3<Real>& q, Real slack) const {
    const Vector3<Real> g = q - eye_;
    const Real h = dot(n_, g);
    if (!(h < 0)) return false;
    const Real nn = dot(n_, n_);
    if (!(h * h > tiny * tiny * nn * dot(g, g)) || !can_hide(nn)) return false;
    // Unless q comes out behind the obstacle, it may be before it, or on another side of it.
    const Vector3<Real> aq = q - edge_.end[0];
    const Real q0 = dot(aq, edge_.normal[0]), q1 = dot(aq, edge_.normal[1]);
    const bool first = dot(a_, edge_.normal[0]) < dot(a_, edge_.normal[1]);  // faces the eye
    const Real front = first ? q0 : q1, back = first ? q1 : q0;
    if (back <= tiny && front >= -tiny) return false;
    if (back < -tiny) {
      const Real along = dot(a_, edge_.direction);
      if (!(dot(aq, a_ - along * edge_.direction) > 0)) return false;
    }
    return outside(q, nn) <= slack * edge_.length;
  }

  /// How closely the line of sight to q passes it: an angle, squared.
  [[nodiscard]] Real closeness(const Vector3<Real>& q) const {
    const Real nn = dot(n_, n_);
    if (!can_hide(nn)) return std::numeric_limits<Real>::infinity();
    const Vector3<Real> g = q - eye_;
    const Real h = dot(n_, g), beyond = outside(q, nn);
    const Real sine2 = h * h / (nn * dot(g, g));
    if (beyond == 0) return sine2;
    const Vector3<Real> b = edge_.end[1] - eye_;
    return sine2 + beyond * beyond / std::min(dot(a_, a_), dot(b, b));
  }

 private:
  static constexpr Real tiny = solid_rounding<Real>;

  /// Not end on; an eye in front of both sides of the edge has nothing hidden from it; well behind
  /// both it does not see the edge, unless that is almost flat.
  [[nodiscard]] bool can_hide(Real nn) const {
    if (!(nn > tiny * tiny * dot(a_, a_))) return false;
    const Real s0 = dot(a_, edge_.normal[0]), s1 = dot(a_, edge_.normal[1]);
    if (std::max(s0, s1) < 0) return false;
    return std::min(s0, s1) <= 1024 * tiny || dot(edge_.normal[0], edge_.normal[1]) >= Real(0.5);
  }

  /// How far beyond its ends the path over the edge would bend, by unfolding.
  [[nodiscard]] Real outside(const Vector3<Real>& q, Real nn) const {
    const Real x = crossing_along(edge_, eye_, std::sqrt(nn), q);
    return std::max(std::max(-x, x - edge_.length), Real(0));
  }

  const ReflexEdge<Real>& edge_;
  const Vector3<Real>& eye_;
  Vector3<Real> a_, n_;
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

}  // namespace plexway
