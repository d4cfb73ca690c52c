// What hides a point in a solid: one text for C++ (the body of kernel::SolidSight<Real>, see
// solid_sight.hpp) and GLSL (shaders/solid.glsl). Before it stand Real, Index, and
//   Point  three coordinates, with + - and multiples, dot, cross and norm
//   Edge   a ReflexEdge (complex/tet_record.hpp)
// Structs are plain, and a struct that several functions need beside others is given to each.

/// Relative rounding that decisions must survive.
HINGE_CONST Real solid_rounding = Real(64) * HINGE_EPSILON;

/// A point, or the eye, from a reflex edge: how far along its line, and how far off it.
struct FromEdge {
  Real along, off;
};

HINGE_FN FromEdge from_edge(HINGE_IN(Edge) e, HINGE_IN(Point) p) {
  Point a = p - e.end[0];
  Real along = dot(a, e.direction);
  FromEdge from = {along, norm(a - along * e.direction)};
  return from;
}

/// Where the unfolded line from p to q crosses an edge, as a distance from its first end that may
/// lie outside of the edge.
HINGE_FN Real crossing_along(HINGE_IN(FromEdge) p, HINGE_IN(FromEdge) q) {
  Real sum = p.off + q.off;
  if (HINGE_RARE(!(sum > Real(0)))) return p.along;
  return (p.along * q.off + q.along * p.off) / sum;
}

/// The point at a distance along an edge, or the nearer end.
HINGE_FN Point point_on(HINGE_IN(Edge) e, Real along) {
  return e.end[0] + clamp(along, Real(0), e.extent) * e.direction;
}

/// The shortest way from p to q over an edge.
struct WayOver {
  Point bend;
  Real extent;
};

/// Unfolds q about the edge's line until it lies opposite p, and draws a straight line; or bends at
/// an end.
HINGE_FN WayOver way_over(HINGE_IN(Edge) e, HINGE_IN(FromEdge) from, HINGE_IN(Point) q) {
  FromEdge to = from_edge(e, q);
  Real x = crossing_along(from, to);
  if (HINGE_LIKELY(x >= Real(0) && x <= e.extent)) {
    Real along = to.along - from.along;
    Real off = to.off + from.off;
    WayOver straight = {e.end[0] + x * e.direction, sqrt(along * along + off * off)};
    return straight;
  }
  Real end = x < Real(0) ? Real(0) : e.extent;
  Real xp = end - from.along;
  Real xq = end - to.along;
  WayOver bent = {e.end[0] + end * e.direction,
                  sqrt(xp * xp + from.off * from.off) + sqrt(xq * xq + to.off * to.off)};
  return bent;
}

/// The bend alone.
HINGE_FN Point bend_point(HINGE_IN(Edge) e, HINGE_IN(Point) p, HINGE_IN(Point) q) {
  FromEdge from = from_edge(e, p);
  FromEdge to = from_edge(e, q);
  return point_on(e, crossing_along(from, to));
}

/// The same for any segment.
HINGE_COLD Point bend_point(HINGE_IN(Point) a, HINGE_IN(Point) b, HINGE_IN(Point) p,
                            HINGE_IN(Point) q) {
  Edge edge;
  edge.end[0] = a;
  edge.extent = norm(b - a);
  if (!(edge.extent > Real(0))) return a;
  edge.direction = Real(1) / edge.extent * (b - a);
  return bend_point(edge, p, q);
}

HINGE_COLD bool parallel(HINGE_IN(Edge) a, HINGE_IN(Edge) b) {
  return abs(dot(a.direction, b.direction)) > Real(1 - 1e-6);
}

/// A reflex edge seen from a point.
struct EdgeSight {
  Point a, n;  // to its first end; across the line of sight and the edge
  Real solid;  // n's side: > 0 towards the solid
};

HINGE_FN EdgeSight see_edge(HINGE_IN(Edge) edge, HINGE_IN(Point) eye) {
  EdgeSight s;
  s.a = edge.end[0] - eye;
  s.n = cross(s.a, edge.direction);
  s.solid = dot(s.n, edge.solid);
  return s;
}

/// Not in its shadow, by more than a small angle (squared).
HINGE_COLD bool lights(HINGE_IN(EdgeSight) s, HINGE_IN(Point) eye, HINGE_IN(Point) q, Real angle2) {
  Point g = q - eye;
  Real h = s.solid < Real(0) ? -dot(s.n, g) : dot(s.n, g);
  return h > Real(0) && h * h > angle2 * dot(s.n, s.n) * dot(g, g);
}

/// Not end on; an eye in front of both sides of the edge has nothing hidden from it; well behind
/// both it does not see the edge, unless that is almost flat.
HINGE_FN bool can_hide(HINGE_IN(Edge) edge, HINGE_IN(EdgeSight) s, Real nn) {
  if (!(nn > solid_rounding * solid_rounding * dot(s.a, s.a))) return false;
  Real s0 = dot(s.a, edge.normal[0]);
  Real s1 = dot(s.a, edge.normal[1]);
  if (max(s0, s1) < Real(0)) return false;
  return min(s0, s1) <= Real(1024) * solid_rounding ||
         dot(edge.normal[0], edge.normal[1]) >= Real(0.5);
}

/// Does q, on the dark side, come out behind the obstacle? Else it may be before it, or on another
/// side of it.
HINGE_FN bool comes_out_behind(HINGE_IN(Edge) edge, HINGE_IN(EdgeSight) s, HINGE_IN(Point) q,
                               HINGE_IN(Point) g, Real h, Real nn, Real eye_along) {
  if (!(h * h > solid_rounding * solid_rounding * nn * dot(g, g))) return false;
  Point aq = q - edge.end[0];
  Real q0 = dot(aq, edge.normal[0]);
  Real q1 = dot(aq, edge.normal[1]);
  bool first = dot(s.a, edge.normal[0]) < dot(s.a, edge.normal[1]);  // faces the eye
  Real front = first ? q0 : q1;
  Real back = first ? q1 : q0;
  if (back <= solid_rounding && front >= -solid_rounding) return false;
  return !(back < -solid_rounding) || dot(aq, s.a + eye_along * edge.direction) > Real(0);
}

/// Where a path bends, as a distance from the edge's first end: times / sum.
struct Crossing {
  Real times, sum;
};

/// Is q in its shadow? `slack`: how far beyond its ends it still hides, in its own lengths. Says
/// also where the path would bend. Most edges do not hide a point, and most of those because it
/// lies on their bright side.
HINGE_FN bool hides_point(HINGE_IN(Edge) edge, HINGE_IN(EdgeSight) s, HINGE_IN(Point) eye,
                          HINGE_IN(Point) q, Real slack, HINGE_INOUT(Crossing) crossing) {
  Point g = q - eye;
  Real h = dot(s.n, g);
  if (HINGE_LIKELY(s.solid * h >= Real(0))) return false;
  Real nn = dot(s.n, s.n);
  if (!can_hide(edge, s, nn)) return false;
  Real eye_along = dot(s.a, edge.direction) * Real(-1);
  Real eye_off = sqrt(nn);
  FromEdge there = from_edge(edge, q);
  Real x = eye_along * there.off + there.along * eye_off;
  Real sum = eye_off + there.off;
  Real most = slack * edge.extent * sum;
  if (!(x >= -most && x - edge.extent * sum <= most)) return false;
  crossing.times = x;
  crossing.sum = sum;
  return comes_out_behind(edge, s, q, g, h, nn, eye_along);
}

struct SightRank {
  Real closeness;  // how closely the line of sight passes an edge: an angle, squared
  bool dark;       // as `hides_point` says
};

/// infinity: it can hide nothing, or does not hide q and is no closer than `worst`.
HINGE_COLD SightRank rank_edge(HINGE_IN(Edge) edge, HINGE_IN(EdgeSight) s, HINGE_IN(Point) eye,
                               HINGE_IN(Point) q, Real slack, Real worst) {
  SightRank rank = {HINGE_INFINITY, false};
  Point g = q - eye;
  Real h = dot(s.n, g);
  Real nn = dot(s.n, s.n);
  Real sine2 = h * h / (nn * dot(g, g));
  if ((s.solid * h >= Real(0) && sine2 >= worst) || !can_hide(edge, s, nn)) return rank;
  FromEdge from = {dot(s.a, edge.direction) * Real(-1), sqrt(nn)};
  FromEdge there = from_edge(edge, q);
  Real x = crossing_along(from, there);
  Real beyond = max(max(-x, x - edge.extent), Real(0));
  Point b = edge.end[1] - eye;
  rank.closeness = sine2 + beyond * beyond / min(dot(s.a, s.a), dot(b, b));
  rank.dark = s.solid * h < Real(0) && beyond <= slack * edge.extent &&
              comes_out_behind(edge, s, q, g, h, nn, from.along);
  return rank;
}

/// Does the line from `eye` to q, on the other side, pass triangle (a, b, c)? Give or take
/// `tolerance` in each barycentric coordinate. Seen from q the triangle runs anticlockwise.
HINGE_COLD bool passes(HINGE_IN(Point) eye, HINGE_IN(Point) q, HINGE_IN(Point) a, HINGE_IN(Point) b,
                       HINGE_IN(Point) c, Real tolerance) {
  Point g = q - eye;
  Point u = a - eye;
  Point v = b - eye;
  Point w = c - eye;
  Point gu = cross(g, u);
  Point gv = cross(g, v);
  Real wc = dot(gu, v);
  Real wa = dot(gv, w);
  Real wb = -dot(gu, w);
  Real sum = wa + wb + wc;
  Real least = min(min(wa, wb), wc);
  // On our side of the plane, give or take rounding.
  Real height = dot(u, cross(b - a, c - a));
  Real scale = abs(sum) + abs(height);
  return sum > Real(0) && least >= -tolerance * sum && height >= -solid_rounding * scale;
}
