// What hides a point in a solid: one text for C++ (the body of kernel::SolidSight<Real>, see
// solid_sight.hpp) and GLSL (shaders/solid.glsl). Before it stand Real, Index, and
//   Point  three coordinates, with + - and multiples, dot, cross and norm
//   Edge   a ReflexEdge (complex/tet_record.hpp)
// Structs are plain, and a struct that several functions need beside others is given to each.

/// Relative rounding that decisions must survive.
HINGE_CONST Real solid_rounding = Real(64) * HINGE_EPSILON;

/// Across a and b: what SolidRule calls `cross` is another thing.
HINGE_FN Point normal_to(HINGE_IN(Point) a, HINGE_IN(Point) b) { return cross(a, b); }

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

/// Where the shortest way from p to q over an edge bends.
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

/// Do both faces at an edge lie on each other, so that the solid goes all around?
HINGE_FN bool is_cracks(HINGE_IN(Edge) edge) {
  return dot(edge.normal[0], edge.normal[1]) < Real(-1 + 1e-6);
}
/// So near to a crack's plane, in lengths from its end, does a point lie in it.
HINGE_CONST Real in_crack = Real(16) * solid_rounding;

/// Does p lie in the plane of the crack that ends in this edge, on the side of the crack?
HINGE_FN bool is_along(HINGE_IN(Edge) edge, HINGE_IN(Point) p) {
  Point off = p - edge.end[0];
  Point across = off - dot(off, edge.direction) * edge.direction;
  Real height = dot(across, edge.normal[0]);
  return height * height <= in_crack * in_crack * dot(across, across) &&
         dot(across, edge.solid) < Real(0);
}

/// Does a string from p over the edge to q press against what is behind it? Else it would lift off:
/// q lies in front of the plane through p and the edge. Along a crack to its end it may come on
/// either side, and then to the other one it presses.
HINGE_FN bool presses(HINGE_IN(Edge) edge, HINGE_IN(Point) p, HINGE_IN(Point) q) {
  Point n = cross(edge.end[0] - p, edge.direction);
  Real side = dot(n, edge.solid);
  Real on = dot(n, q - p);
  if (HINGE_RARE(side * side <= in_crack * in_crack * dot(n, n)) && is_cracks(edge) &&
      is_along(edge, p))
    return on * on > in_crack * in_crack * dot(n, n) * dot(q - p, q - p) || is_along(edge, q);
  return side * on < Real(0);
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
