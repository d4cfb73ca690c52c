// Straight lines through the tetrahedra of a solid: one text for C++ (part of the body of
// SolidRule) and GLSL, after solid_paths.inl. Before it stand also, for tetrahedra t by number,
//   centre_of(t), corner_of(t, i)    points
//   face_corner(t, face, k)          corners of a face, anticlockwise as seen from outside
//   vertex_of(t, i)                  numbers of the corners
//   face_corner_number(face, k)      which corners those of a face are
//   neighbour(t, i), face_beyond(t, i)  over face i, or no_tet(); the number of the face there
//   component(p, i)                  coordinate i of a point

/// So far from an edge, into the solid, strings are walked: then a line along a face of an obstacle
/// does not cross it by rounding. In mean edges.
HINGE_CONST Real nudge = Real(1e-3);

struct Hit {
  Index tet;  // in which the line left the solid
  int leg;    // of the string: it begins at bend number `leg`
};
HINGE_FN Hit nowhere() {
  Hit hit = {none, 0};
  return hit;
}

/// A point as seen along a line: across it, and along it from 0 to 1 at its end. Not a rotation but
/// a shear along the axis that the line runs along most, which is less work and turns as well.
struct Seen {
  Real x, y, z;
};
struct Line {
  Index across, up, along;  // the axes
  Real x, y, scale;
};
HINGE_FN Line line_along(HINGE_IN(Point) g) {
  Line line = {1u, 2u, 0u, Real(0), Real(0), Real(0)};
  if (abs(g.y) > abs(g.x)) {
    Line other = {2u, 0u, 1u, Real(0), Real(0), Real(0)};
    line = other;
  }
  if (abs(g.z) > abs(component(g, line.along))) {
    Line other = {0u, 1u, 2u, Real(0), Real(0), Real(0)};
    line = other;
  }
  Real most = component(g, line.along);
  if (most < Real(0)) {
    Index other = line.across;
    line.across = line.up;
    line.up = other;
  }
  line.x = component(g, line.across);
  line.y = component(g, line.up);
  line.scale = Real(1) / most;
  return line;
}
HINGE_METHOD Seen seen_along(HINGE_IN(Line) line, HINGE_IN(Point) from,
                             HINGE_IN(Point) p) HINGE_READS {
  Point w = p - from;
  Real z = component(w, line.along) * line.scale;
  Seen seen = {component(w, line.across) - z * line.x, component(w, line.up) - z * line.y, z};
  return seen;
}

/// On which side of b is a, seen from the line?
HINGE_FN Real turn_of(HINGE_IN(Seen) a, HINGE_IN(Seen) b) { return a.x * b.y - a.y * b.x; }

/// Lines begin so far inside of their tetrahedron, as a share of the way to a point of it. On a
/// lattice a line between two edges may run exactly into others, and be led around these to
/// anywhere; this one passes beside them. A point that is in no plane of such a lattice: the centre
/// is in many.
HINGE_CONST Real inset = Real(1e-5);
HINGE_METHOD Point point_inside(Index t) HINGE_READS {
  Point centre = centre_of(t);
  return centre + Real(0.3094) * (corner_of(t, 0u) - centre) +
         Real(0.1732) * (corner_of(t, 1u) - centre);
}
/// A line that misses a face of the boundary by more than this share of it does not end there.
HINGE_CONST Real face_missed = Real(1e-2);

/// From a point of t straight to another; t is then the tetrahedron it came to. False if that is
/// outside of the solid, or behind a part of the boundary.
bool walk(HINGE_INOUT(Index) t, HINGE_IN(Point) begin, HINGE_IN(Point) to) HINGE_READS {
  Point from = begin + inset * (point_inside(t) - begin);
  Point g = to - from;
  Real far = norm(g);
  if (!(far > Real(1e-2) * nudge)) return true;
  Line line = line_along(g);
  // By which face does it leave the first one?
  Seen p[4];
  for (int i = 0; i < HINGE_ROLLED(4); ++i) p[i] = seen_along(line, from, corner_of(t, Index(i)));
  int exit = 0;
  Real best = -HINGE_INFINITY;
  for (int i = 0; i < HINGE_ROLLED(4); ++i) {
    Seen a = p[face_corner_number(Index(i), 0u)];
    Seen b = p[face_corner_number(Index(i), 1u)];
    Seen c = p[face_corner_number(Index(i), 2u)];
    Real ab = turn_of(a, b);
    Real bc = turn_of(b, c);
    Real ca = turn_of(c, a);
    Real sum = ab + bc + ca;
    if (!(sum > Real(0))) continue;
    Real least = min(min(ab, bc), ca);
    if (least >= Real(0)) {
      exit = i;
      break;
    }
    // By rounding by none? The nearest to it.
    if (least > best * sum) {
      best = least / sum;
      exit = i;
    }
  }
  Index face = Index(exit);
  Seen a = p[face_corner_number(face, 0u)];
  Seen b = p[face_corner_number(face, 1u)];
  Seen c = p[face_corner_number(face, 2u)];
  Index va = vertex_of(t, face_corner_number(face, 0u));
  Index vb = vertex_of(t, face_corner_number(face, 1u));
  Index vc = vertex_of(t, face_corner_number(face, 2u));
  Real top = max(a.z, max(b.z, c.z));  // no corner of the face is farther along
  Index passed = t;  // now and then: a line that comes back goes round in circles by rounding
  for (int steps = 0; steps < HINGE_ROLLED(65536); ++steps) {
    Index next = neighbour(t, face);
    bool ends = next == no_tet();
    if (HINGE_RARE(ends || !(top < Real(1)))) {
      // Is the end before this face? A face that the line lies in, by rounding, cannot tell; what
      // comes behind it can.
      Real wa = turn_of(b, c);
      Real wb = turn_of(c, a);
      Real wc = turn_of(a, b);
      Real sum = wa + wb + wc;
      bool edge_on = !(sum > Real(0));
      if (edge_on && ends) return false;
      Real beyond = wa * (Real(1) - a.z) + wb * (Real(1) - b.z) + wc * (Real(1) - c.z);
      bool missed = min(min(wa, wb), wc) < -face_missed * sum;
      if (!edge_on && beyond <= Real(0)) return !missed;
      if (ends) {
        if (missed) return false;
        // What remains may be no more than rounding: in length, or in depth below the face.
        if (beyond * far <= Real(1e-2) * nudge * sum) return true;
        Point at = face_corner(t, face, 0u);
        Point n = normal_to(face_corner(t, face, 1u) - at, face_corner(t, face, 2u) - at);
        return dot(n, to - at) <= Real(1e-2) * nudge * norm(n);
      }
    }
    Index j = face_beyond(t, face);
    t = next;
    if (HINGE_RARE(t == passed)) return false;
    if ((steps & (steps - 1)) == 0) passed = t;
    Seen d = seen_along(line, from, corner_of(t, j));
    Index vd = vertex_of(t, j);
    top = max(top, d.z);
    // It leaves by one of the three faces at the new corner, opposite one of the others.
    bool left = turn_of(b, d) >= Real(0);
    Index opposite = vb;
    if (left && turn_of(a, d) <= Real(0)) {
      opposite = vc;
      c = d;
      vc = vd;
    } else if (!left && turn_of(c, d) >= Real(0)) {
      opposite = va;
      a = d;
      va = vd;
    } else {
      b = d;
      vb = vd;
    }
    face = 0u;
    for (int i = 1; i < HINGE_ROLLED(4); ++i)
      if (vertex_of(t, Index(i)) == opposite) face = Index(i);
  }
  return false;
}
