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

/// How a line of sight from an eye to q passes a reflex edge.
template <class Real>
struct Shade {
  bool dark = false;     ///< q is behind it
  Real light = 0;        ///< sine of the angle by which q is out of its shadow; < 0: in it
  Real beyond = 0;       ///< q's distance over the edge's, along the line of sight
  Real angle2 = std::numeric_limits<Real>::infinity();  ///< how closely it passes, squared
};

/// `slack`: how far beyond the edge's ends it still hides, in lengths of the edge.
template <class Real>
Shade<Real> shade(const ReflexEdge<Real>& edge, const Vector3<Real>& eye, const Vector3<Real>& q,
                  Real slack) {
  Shade<Real> s;
  const Vector3<Real> a = edge.end[0] - eye, b = edge.end[1] - eye, g = q - eye;
  const Vector3<Real> n = cross(a, b);
  const Real nn = dot(n, n), gg = dot(g, g);
  constexpr Real tiny = solid_rounding<Real>;
  if (!(nn > tiny * tiny * dot(a, a) * dot(b, b)) || !(gg > 0)) return s;  // end on
  // Facing both sides of the edge: it hides nothing.
  if (std::max(dot(a, edge.normal[0]), dot(a, edge.normal[1])) < 0) return s;
  const Real across = dot(n, edge.normal[0] + edge.normal[1]);  // the solid is there
  const Real h = dot(n, g) / std::sqrt(nn * gg);
  s.light = across > 0 ? h : -h;
  const Real alpha = dot(cross(g, b), n), beta = dot(cross(a, g), n), sum = alpha + beta;
  s.beyond = sum / nn;
  if (!(s.beyond > tiny)) return s;
  const Real at = beta / sum;
  const Vector3<Real> m = a + std::clamp(at, Real(0), Real(1)) * (b - a);
  const Vector3<Real> off = Real(1) / s.beyond * g - m;
  s.angle2 = dot(off, off) / dot(m, m);
  s.dark = s.light < -tiny && s.beyond > 1 && at > -slack && at < 1 + slack;
  return s;
}

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
