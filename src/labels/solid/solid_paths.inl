// The path that a label of a solid describes: a string from the virtual source S around reflex
// edges to a point, pulled taut. One text for C++ (the body of SolidPaths<Real>, see
// solid_paths.hpp) and GLSL, after solid_sight.inl. Before it stand also
//   Label               a SolidLabel (labels/solid/solid_label.hpp), and `label_bends`, how many
//   none                no edge
//   unfolded_door       with an edge added: the door of a label whose S was turned about it
//   beside_door         with a tetrahedron added: of one whose strings begin in that, beside S
//   reflex_edge(Index)  an Edge
//   own_edges()         edges from there on are further ones, which only bend paths

/// A string under way may have more bends than a label keeps.
HINGE_CONST int most_bends = label_bends + 3;

struct Taut {
  Point at[most_bends + 2];  // S, the bends, the end
  Index edge[most_bends];    // the reflex edge of each bend
  int bends;
  Real extent;  // of the whole path
};

HINGE_METHOD Point taut_end(HINGE_IN(Taut) s) HINGE_READS { return s.at[s.bends + 1]; }

void measure(HINGE_INOUT(Taut) s, Real sigma) HINGE_READS {
  s.extent = sigma;
  for (int i = 0; i <= HINGE_ROLLED(s.bends); ++i) s.extent += norm(s.at[i + 1] - s.at[i]);
}

/// Moves the bends near to where the string is shortest, given its edges and ends: one by one,
/// there and back. One bend is where it belongs then.
void slide(HINGE_INOUT(Taut) s) HINGE_READS {
  int k = s.bends;
  Point end = s.at[k + 1];
  for (int i = 0; i < HINGE_ROLLED(k); ++i)
    s.at[i + 1] = bend_point(reflex_edge(s.edge[i]), s.at[i], end);
  for (int n = 1; n < HINGE_ROLLED(k); ++n) {
    int i = k - 1 - n;
    s.at[i + 1] = bend_point(reflex_edge(s.edge[i]), s.at[i], s.at[i + 2]);
  }
}

/// Several bends the rest of the way: Newton's method for all at once. Lengths are convex.
void settle(HINGE_INOUT(Taut) s, Real sigma) HINGE_READS {
  int k = s.bends;
  Point end = s.at[k + 1];
  Real way[most_bends + 1];  // from bend to bend
  s.extent = sigma;
  for (int i = 0; i <= HINGE_ROLLED(k); ++i) {
    way[i] = norm(s.at[i + 1] - s.at[i]);
    s.extent += way[i];
  }
  for (int round = 0; round < HINGE_ROLLED(8); ++round) {
    // Rows of the Hessian, eliminated as they come: diagonal, to the next, right side.
    Real upper[most_bends];
    Real right[most_bends];
    Point come = s.at[1] - s.at[0];
    Real way_in = max(way[0], Real(1e-9));
    come = Real(1) / way_in * come;
    for (int i = 0; i < HINGE_ROLLED(k); ++i) {
      HINGE_IN(Edge) e = reflex_edge(s.edge[i]);
      Point on = s.at[i + 2] - s.at[i + 1];
      Real way_on = max(way[i + 1], Real(1e-9));
      on = Real(1) / way_on * on;
      Real a = dot(e.direction, come);
      Real b = dot(e.direction, on);
      Real slope = a - b;
      Real x = dot(s.at[i + 1] - e.end[0], e.direction);
      Real diagonal = (Real(1) - a * a) / way_in + (Real(1) - b * b) / way_on;
      Real next = Real(0);
      Real before = Real(0);
      if (i + 1 < k) {
        HINGE_IN(Edge) f = reflex_edge(s.edge[i + 1]);
        next = (b * dot(f.direction, on) - dot(e.direction, f.direction)) / way_on;
      }
      if (i > 0) {
        HINGE_IN(Edge) f = reflex_edge(s.edge[i - 1]);
        before = (a * dot(f.direction, come) - dot(e.direction, f.direction)) / way_in;
      }
      // At an end, and pulled beyond it: stays.
      bool stays = (x <= Real(0) && slope > Real(0)) || (x >= e.extent && slope < Real(0)) ||
                   !(diagonal > Real(0));
      if (stays) {
        upper[i] = Real(0);
        right[i] = Real(0);
      } else {
        Real pivot = diagonal;
        Real rest = -slope;
        if (i > 0) {
          pivot -= before * upper[i - 1];
          rest -= before * right[i - 1];
        }
        pivot = max(pivot, Real(1e-3) * diagonal);
        upper[i] = next / pivot;
        right[i] = rest / pivot;
      }
      come = on;
      way_in = way_on;
    }
    Point moved[most_bends];
    Real step = Real(0);
    Real farthest = Real(0);
    for (int n = 0; n < HINGE_ROLLED(k); ++n) {
      int i = k - 1 - n;
      step = right[i] - upper[i] * step;
      HINGE_IN(Edge) e = reflex_edge(s.edge[i]);
      Real x = dot(s.at[i + 1] - e.end[0], e.direction);
      moved[i] = point_on(e, x + step);
      farthest = max(farthest, abs(step));
    }
    Real extent = sigma;
    Point last = s.at[0];
    for (int i = 0; i < HINGE_ROLLED(k); ++i) {
      way[i] = norm(moved[i] - last);
      extent += way[i];
      last = moved[i];
    }
    way[k] = norm(end - last);
    extent += way[k];
    if (!(extent < s.extent)) break;
    s.extent = extent;
    for (int i = 0; i < HINGE_ROLLED(k); ++i) s.at[i + 1] = moved[i];
    if (farthest < Real(1e-3)) break;  // it converges quadratically
  }
}

HINGE_METHOD bool at_an_end(HINGE_IN(Edge) e, HINGE_IN(Point) bend) HINGE_READS {
  Real x = dot(bend - e.end[0], e.direction);
  return !(x > Real(1e-6) * e.extent && x < Real(1 - 1e-6) * e.extent);
}

void leave_out(HINGE_INOUT(Taut) s, int i) HINGE_READS {
  Point end = s.at[s.bends + 1];
  for (int n = 0; n + 1 < HINGE_ROLLED(s.bends); ++n)
    if (n >= i) s.edge[n] = s.edge[n + 1];
  --s.bends;
  s.at[s.bends + 1] = end;
}

/// The first bend that a string lifts off, or -1. `kept`: so many of the first must stay.
/// `strict`: also one at its edge's end: the string may get past there.
int lifted(HINGE_IN(Taut) s, int kept, bool strict) HINGE_READS {
  for (int i = kept; i < HINGE_ROLLED(s.bends); ++i) {
    HINGE_IN(Edge) e = reflex_edge(s.edge[i]);
    if (!presses(e, s.at[i], s.at[i + 2]) || (strict && at_an_end(e, s.at[i + 1]))) return i;
  }
  return -1;
}

/// Pulls a string taut: edges that it lifts off are left out.
void pull(HINGE_INOUT(Taut) s, Real sigma, int kept, bool strict) HINGE_READS {
  for (;;) {
    slide(s);
    int off = lifted(s, kept, strict);
    if (off < 0 && s.bends > 1) {
      settle(s, sigma);
      off = lifted(s, kept, strict);
    } else if (off < 0) {
      measure(s, sigma);
    }
    if (off < 0) return;
    leave_out(s, off);
  }
}

HINGE_METHOD bool is_unfolded(HINGE_IN(Label) label) HINGE_READS {
  return label.door >= unfolded_door && label.door < beside_door;
}
/// Do strings begin beside S, in a tetrahedron?
HINGE_METHOD bool begins_beside(HINGE_IN(Label) label) HINGE_READS {
  return label.door != none && label.door >= beside_door;
}

/// Edges of a label that belong to its S.
HINGE_METHOD int fixed_bends(HINGE_IN(Label) label) HINGE_READS {
  if (label.bend[0] == none) return 0;
  return label.bend[0] >= own_edges() || is_unfolded(label) ? 1 : 0;
}

/// The label's string to q, not pulled yet.
Taut edges_of(HINGE_IN(Label) label, HINGE_IN(Point) q) HINGE_READS {
  Taut s;
  s.at[0] = label.source;
  s.bends = 0;
  s.extent = Real(0);
  for (int i = 0; i < most_bends; ++i) {
    s.at[i + 1] = q;
    s.edge[i] = none;
  }
  for (int i = 0; i < label_bends; ++i) {
    if (label.bend[i] == none) break;
    s.edge[s.bends++] = label.bend[i];
  }
  return s;
}
/// And pulled.
Taut taut_to(HINGE_IN(Label) label, HINGE_IN(Point) q) HINGE_READS {
  Taut s = edges_of(label, q);
  pull(s, label.sigma, fixed_bends(label), true);
  return s;
}

HINGE_DO void clear_bends(HINGE_INOUT(Label) label) {
  for (int k = 0; k < label_bends; ++k) label.bend[k] = none;
}

HINGE_METHOD bool is_beside(HINGE_IN(Edge) e, HINGE_IN(Point) p) HINGE_READS {
  Real x = dot(p - e.end[0], e.direction);
  return x >= Real(-1e-6) * e.extent && x <= Real(1 + 1e-6) * e.extent;
}
/// May S turn about an edge? Of a label that was turned before only if all paths over this edge
/// pass the edge before within its ends.
bool may_turn(HINGE_IN(Label) label, HINGE_IN(Edge) e) HINGE_READS {
  if (!is_unfolded(label)) return true;
  HINGE_IN(Edge) before = reflex_edge(label.door - unfolded_door);
  return is_beside(before, label.source) && is_beside(before, e.end[0]) &&
         is_beside(before, e.end[1]);
}

/// May S turn about the first edge of its string into the plane of that and the second? Then it
/// stays exact for all paths over both.
bool may_turn(HINGE_IN(Taut) s, HINGE_IN(Label) label) HINGE_READS {
  HINGE_IN(Edge) e = reflex_edge(s.edge[0]);
  HINGE_IN(Edge) next = reflex_edge(s.edge[1]);
  return parallel(e, next) && from_edge(e, next.end[0]).off > Real(0) && !at_an_end(e, s.at[1]) &&
         may_turn(label, e);
}
/// Takes the first bend out: S turns, or the bend becomes S.
void leave_first(HINGE_INOUT(Taut) s, HINGE_INOUT(Label) label, bool turns) HINGE_READS {
  if (turns) {
    // As far along the edge and off it as it was, wherever the bends are by rounding.
    HINGE_IN(Edge) e = reflex_edge(s.edge[0]);
    FromEdge source = from_edge(e, label.source);
    Point across = e.end[0] - reflex_edge(s.edge[1]).end[0];
    across = across - dot(across, e.direction) * e.direction;
    label.source = e.end[0] + source.along * e.direction + source.off / norm(across) * across;
    label.door = unfolded_door + s.edge[0];
  } else {
    label.sigma += norm(s.at[1] - label.source);
    label.source = s.at[1];
    label.door = none;
  }
  s.at[0] = label.source;
  for (int i = 1; i < HINGE_ROLLED(s.bends + 1); ++i) s.at[i] = s.at[i + 1];
  for (int i = 1; i < HINGE_ROLLED(s.bends); ++i) s.edge[i - 1] = s.edge[i];
  --s.bends;
}
/// The string with one more bend on its first edge, which comes first.
Taut bent_along(HINGE_IN(Taut) s, HINGE_IN(Point) at) HINGE_READS {
  Taut along = s;
  for (int i = 1; i < HINGE_ROLLED(s.bends + 2); ++i) along.at[i + 1] = s.at[i];
  for (int i = 0; i < HINGE_ROLLED(s.bends); ++i) along.edge[i + 1] = s.edge[i];
  along.at[1] = at;
  ++along.bends;
  return along;
}

/// Makes a label of a string that has no more bends than it can keep.
void set_bends(HINGE_IN(Taut) s, HINGE_INOUT(Label) label) HINGE_READS {
  for (int i = 0; i < label_bends; ++i) {
    label.bend[i] = none;
    if (i < s.bends) label.bend[i] = s.edge[i];
  }
  label.centre = s.extent;
}
