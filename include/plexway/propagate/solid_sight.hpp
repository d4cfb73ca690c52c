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

/// The point of segment (a, b) over which p reaches q soonest: unfold q about the line through a
/// and b until it lies opposite p, and draw a straight line; or an end.
template <class Real>
Vector3<Real> bend_point(const Vector3<Real>& a, const Vector3<Real>& b, const Vector3<Real>& p,
                         const Vector3<Real>& q) {
  const Vector3<Real> u = b - a, ap = p - a, aq = q - a;
  const Real length2 = dot(u, u);
  if (!(length2 > 0)) return a;
  const Real xp = dot(ap, u) / length2, xq = dot(aq, u) / length2;
  const Vector3<Real> op = ap - xp * u, oq = aq - xq * u;
  const Real hp = norm(op), hq = norm(oq), h = hp + hq;
  const Real x = h > 0 ? (xp * hq + xq * hp) / h : xp;
  return a + std::clamp(x, Real(0), Real(1)) * u;
}
template <class Real>
Vector3<Real> bend_point(const ReflexEdge<Real>& e, const Vector3<Real>& p,
                         const Vector3<Real>& q) {
  return bend_point(e.end[0], e.end[1], p, q);
}

/// A reflex edge seen from a point.
template <class Real>
class EdgeView {
 public:
  EdgeView(const ReflexEdge<Real>& edge, const Vector3<Real>& eye) : edge_(edge), eye_(eye) {
    a_ = edge.end[0] - eye;
    u_ = edge.end[1] - edge.end[0];
    n_ = cross(a_, u_);
    nn_ = dot(n_, n_);
    uu_ = dot(u_, u_);
    front_ = -dot(a_, edge.normal[0]);
    back_ = -dot(a_, edge.normal[1]);
    const bool end_on = !(nn_ > tiny * tiny * dot(a_, a_) * uu_);
    // In front of both sides of the edge an eye has nothing hidden from it; well behind both it
    // does not see the edge, unless that is almost flat.
    const bool before = std::min(front_, back_) > 0;
    const bool behind = std::max(front_, back_) < -1024 * tiny &&
                        dot(edge.normal[0], edge.normal[1]) < Real(0.5);
    can_hide_ = !end_on && !before && !behind;
    if (dot(n_, edge.normal[0] + edge.normal[1]) < 0) n_ = Real(-1) * n_;  // to the solid's side
  }

  [[nodiscard]] bool can_hide() const { return can_hide_; }

  /// Not in its shadow, give or take a small angle (squared).
  [[nodiscard]] bool lights(const Vector3<Real>& q, Real angle2) const {
    const Vector3<Real> g = q - eye_;
    const Real h = dot(n_, g);
    return h > 0 && h * h > angle2 * nn_ * dot(g, g);
  }

  /// Is q in its shadow? `slack`: how far beyond its ends it still hides, in its own lengths.
  [[nodiscard]] bool hides(const Vector3<Real>& q, Real slack) const {
    if (!can_hide_) return false;
    const Vector3<Real> g = q - eye_;
    const Real h = dot(n_, g);
    if (!(h < 0) || !(h * h > tiny * tiny * nn_ * dot(g, g))) return false;
    // q may be before the obstacle.
    const Vector3<Real> aq = q - edge_.end[0];
    const Real q0 = dot(aq, edge_.normal[0]), q1 = dot(aq, edge_.normal[1]);
    if (front_ > back_ ? q1 <= tiny && q0 >= -tiny : q0 <= tiny && q1 >= -tiny) return false;
    return outside(aq) <= slack;
  }

  /// How closely the line of sight to q passes it: an angle, squared.
  [[nodiscard]] Real closeness(const Vector3<Real>& q) const {
    if (!can_hide_) return std::numeric_limits<Real>::infinity();
    const Vector3<Real> g = q - eye_, aq = q - edge_.end[0];
    const Real h = dot(n_, g), beyond = outside(aq);
    const Real sine2 = h * h / (nn_ * dot(g, g));
    if (beyond == 0) return sine2;
    const Vector3<Real> b = a_ + u_;
    return sine2 + beyond * beyond * uu_ / std::min(dot(a_, a_), dot(b, b));
  }

 private:
  static constexpr Real tiny = solid_rounding<Real>;

  /// How far beyond its ends the path over the edge would bend, by unfolding, in its own lengths.
  [[nodiscard]] Real outside(const Vector3<Real>& aq) const {
    const Real xp = -dot(a_, u_) / uu_, xq = dot(aq, u_) / uu_;
    const Vector3<Real> oq = aq - xq * u_;
    const Real hp = std::sqrt(nn_ / uu_), hq = norm(oq);
    const Real x = (xp * hq + xq * hp) / (hp + hq);
    return std::max(std::max(-x, x - 1), Real(0));
  }

  const ReflexEdge<Real>& edge_;
  const Vector3<Real>& eye_;
  Vector3<Real> a_, u_, n_;
  Real nn_, uu_, front_, back_;
  bool can_hide_;
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
