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

/// How the line of sight from an eye to q passes a reflex edge.
template <class Real>
struct Shade {
  bool dark = false;  ///< the edge hides q: the way there bends at it
  Real light = 0;     ///< sine of the angle by which q is out of its shadow; < 0: in it
  Real close2 = std::numeric_limits<Real>::infinity();  ///< how closely it passes: an angle, squared
};

/// `slack`: how far beyond the edge's ends it still hides, in lengths of the edge.
template <class Real>
Shade<Real> shade(const ReflexEdge<Real>& edge, const Vector3<Real>& eye, const Vector3<Real>& q,
                  Real slack) {
  Shade<Real> s;
  constexpr Real tiny = solid_rounding<Real>, behind = 1024 * tiny;
  const Vector3<Real> a = edge.end[0] - eye, b = edge.end[1] - eye, g = q - eye, u = b - a;
  const Vector3<Real> n = cross(a, u);
  const Real nn = dot(n, n), gg = dot(g, g), uu = dot(u, u);
  if (!(nn > tiny * tiny * dot(a, a) * uu) || !(gg > 0)) return s;  // end on
  // In front of both sides of the edge an eye has nothing hidden from it, and behind both it does
  // not see the edge.
  const Real eye0 = -dot(a, edge.normal[0]), eye1 = -dot(a, edge.normal[1]);
  if (std::min(eye0, eye1) > 0 || std::max(eye0, eye1) < -behind) return s;
  const Real across = dot(n, edge.normal[0] + edge.normal[1]);  // the solid is there
  const Real h = dot(n, g) / std::sqrt(nn * gg);
  s.light = across > 0 ? h : -h;
  // Where the path over the edge would bend, by unfolding.
  const Vector3<Real> aq = q - edge.end[0];
  const Real xp = -dot(a, u) / uu, xq = dot(aq, u) / uu;
  const Vector3<Real> oq = aq - xq * u;
  const Real hp = std::sqrt(nn / uu), hq = norm(oq);
  const Real x = (xp * hq + xq * hp) / (hp + hq);
  const Real outside = std::max(std::max(-x, x - 1), Real(0));
  const Real at = std::clamp(x, Real(0), Real(1));
  const Vector3<Real> m = a + at * u;
  s.close2 = h * h + outside * outside * uu / dot(m, m);
  // Hidden, unless q is before the obstacle rather than behind.
  const Real q0 = dot(aq, edge.normal[0]), q1 = dot(aq, edge.normal[1]);
  const Real front = eye0 > eye1 ? q0 : q1, back = eye0 > eye1 ? q1 : q0;
  const bool before = back <= tiny && front >= -tiny;
  s.dark = s.light < -tiny && !before && outside <= slack;
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
