// Straight lines through the tetrahedra of a solid: one text for C++ (part of the body of
// SolidRule) and GLSL, after solid_paths.inl. Before it stand also, for tetrahedra t by number,
//   centre_of(t), corner_of(t, i)    points
//   face_corner(t, face, k)          corners of a face, anticlockwise as seen from outside
//   vertex_of(t, i)                  numbers of the corners
//   face_corner_number(face, k)      which corners those of a face are
//   neighbour(t, i), face_beyond(t, i)  over face i, or no_tet(); the number of the face there

/// So far from an edge, into the solid, strings are walked: then a line along a face of an obstacle
/// does not cross it by rounding. In mean edges.
HINGE_CONST Real nudge = Real(1e-3);

struct Hit {
  Index tet;  // in which the line left the solid
  int leg;    // of the string: it begins at bend number `leg`
};

/// On which side of b is a, seen from the line?
HINGE_FN Real turn_of(HINGE_IN(Point) a, HINGE_IN(Point) b) { return a.x * b.y - a.y * b.x; }

/// From a point of t straight to another; t is then the tetrahedron it came to. False if that is
/// outside of the solid, or behind a part of the boundary.
bool go(HINGE_INOUT(Index) t, HINGE_IN(Point) from, HINGE_IN(Point) to) HINGE_READS {
  Point g = to - from;
  Real far = norm(g);
  if (!(far > Real(1e-2) * nudge)) return true;
  g = Real(1) / far * g;
  Point u = {Real(0), -g.z, g.y};
  if (abs(g.x) > abs(g.y)) {
    Point other = {g.z, Real(0), -g.x};
    u = other;
  }
  u = Real(1) / norm(u) * u;
  Point v = normal_to(g, u);
  // By which face does it leave the first one?
  Point p[4];
  for (int i = 0; i < HINGE_ROLLED(4); ++i) {
    Point w = corner_of(t, Index(i)) - from;
    Point seen = {dot(u, w), dot(v, w), dot(g, w)};
    p[i] = seen;
  }
  int exit = 0;
  Real best = -HINGE_INFINITY;
  for (int i = 0; i < HINGE_ROLLED(4); ++i) {
    Point a = p[face_corner_number(Index(i), 0u)];
    Point b = p[face_corner_number(Index(i), 1u)];
    Point c = p[face_corner_number(Index(i), 2u)];
    Real ab = turn_of(a, b);
    Real bc = turn_of(b, c);
    Real ca = turn_of(c, a);
    Real sum = ab + bc + ca;
    if (!(sum > Real(0))) continue;
    Real least = min(min(ab, bc), ca) / sum;
    if (least > best) {
      best = least;
      exit = i;
    }
  }
  Index face = Index(exit);
  Point a = p[face_corner_number(face, 0u)];
  Point b = p[face_corner_number(face, 1u)];
  Point c = p[face_corner_number(face, 2u)];
  Index va = vertex_of(t, face_corner_number(face, 0u));
  Index vb = vertex_of(t, face_corner_number(face, 1u));
  Index vc = vertex_of(t, face_corner_number(face, 2u));
  for (int steps = 0; steps < HINGE_ROLLED(65536); ++steps) {
    Index next = neighbour(t, face);
    bool ends = next == no_tet();
    if (ends || !(max(a.z, max(b.z, c.z)) < far)) {
      // Is the end before this face?
      Real wa = turn_of(b, c);
      Real wb = turn_of(c, a);
      Real wc = turn_of(a, b);
      Real sum = wa + wb + wc;
      if (!(sum > Real(0))) return false;
      Real beyond = wa * (far - a.z) + wb * (far - b.z) + wc * (far - c.z);
      if (beyond <= Real(0)) return true;
      if (ends) {
        // What remains may be no more than rounding: in length, or in depth below the face.
        if (beyond <= Real(4) * nudge * sum) return true;
        Point n = normal_to(b - a, c - a);
        Real depth = n.z * (far - a.z) - n.x * a.x - n.y * a.y;
        return depth <= Real(1e-2) * nudge * norm(n);
      }
    }
    Index j = face_beyond(t, face);
    t = next;
    Point w = corner_of(t, j) - from;
    Point d = {dot(u, w), dot(v, w), dot(g, w)};
    Index vd = vertex_of(t, j);
    // It leaves by one of the three faces at the new corner, opposite one of the others.
    Real ad = turn_of(a, d);
    Real bd = turn_of(b, d);
    Real cd = turn_of(c, d);
    Index opposite = vc;
    if (ad <= Real(0) && bd >= Real(0)) {
      c = d;
      vc = vd;
    } else if (bd <= Real(0) && cd >= Real(0)) {
      opposite = va;
      a = d;
      va = vd;
    } else {
      opposite = vb;
      b = d;
      vb = vd;
    }
    face = 0u;
    for (int i = 1; i < HINGE_ROLLED(4); ++i)
      if (vertex_of(t, Index(i)) == opposite) face = Index(i);
  }
  return false;
}
