// The path that a label of a solid describes: from the virtual source, over its ring, around the
// edges it remembers, to a point. One text for C++ (the body of SolidPaths<Real>, see
// solid_paths.hpp) and GLSL, after solid_sight.inl. Before it stand also
//   Label               a SolidLabel (propagate/solid_label.hpp), and `label_limits`, how many
//   none                no edge
//   reflex_edge(Index)  an Edge
//   bent_path(path, edge), path_before(path, edge)  names, see SolidPath

/// So far beyond its ends an edge hides, in its own length.
HINGE_CONST Real slack = Real(0.5);

struct Reach {
  Point eye;    // the last bend
  Real extent;  // of the whole path
  int bend;     // at this limit, or -1
};

HINGE_FN Reach straight_reach(HINGE_IN(Label) label, HINGE_IN(Point) q) {
  Reach there = {label.source, label.sigma + norm(q - label.source), -1};
  return there;
}

/// Where S is from the ring: the same for all q.
HINGE_METHOD FromEdge before_ring(HINGE_IN(Label) label) HINGE_READS {
  FromEdge nothing = {Real(0), Real(0)};
  if (label.ring == none) return nothing;
  return from_edge(reflex_edge(label.ring), label.source);
}
HINGE_METHOD Reach reach(HINGE_IN(Label) label, HINGE_IN(FromEdge) before,
                         HINGE_IN(Point) q) HINGE_READS {
  if (label.ring == none) return straight_reach(label, q);
  WayOver way = way_over(reflex_edge(label.ring), before, q);
  Reach there = {way.bend, label.sigma + way.extent, -1};
  return there;
}
/// The path as the label has it, limits aside.
HINGE_METHOD Reach reach(HINGE_IN(Label) label, HINGE_IN(Point) q) HINGE_READS {
  if (label.ring == none) return straight_reach(label, q);
  return reach(label, before_ring(label), q);
}
HINGE_METHOD Real way_to(HINGE_IN(Label) label, HINGE_IN(Point) q) HINGE_READS {
  return reach(label, q).extent;
}

/// The same with bends at one limit, or at two in a row: relaxed once, which is exact for a single
/// bend after a point and never too short.
Reach reach_by(HINGE_IN(Label) label, HINGE_IN(Point) eye, int limit,
               HINGE_IN(Point) q) HINGE_READS {
  Point b = bend_point(reflex_edge(label.limit[limit]), eye, q);
  Reach there = {b, way_to(label, b) + norm(q - b), limit};
  return there;
}
Reach reach_by(HINGE_IN(Label) label, HINGE_IN(Point) eye, int first, int second,
               HINGE_IN(Point) q) HINGE_READS {
  HINGE_IN(Edge) one = reflex_edge(label.limit[first]);
  HINGE_IN(Edge) two = reflex_edge(label.limit[second]);
  Point b = eye;
  Point c = q;
  for (int n = 0; n < HINGE_ROLLED(2); ++n) {
    b = bend_point(one, eye, c);
    c = bend_point(two, b, q);
  }
  Reach there = {c, way_to(label, b) + norm(c - b) + norm(q - c), first};
  return there;
}

HINGE_METHOD bool hides(Index edge, HINGE_IN(Point) eye, HINGE_IN(Point) q) HINGE_READS {
  HINGE_IN(Edge) e = reflex_edge(edge);
  Crossing unused;
  return hides_point(e, see_edge(e, eye), eye, q, slack, unused);
}

/// The path with what hides q. At `known` or more it need not be exact: it is longer yet.
Reach measure(HINGE_IN(Label) label, HINGE_IN(Point) q, HINGE_IN(Reach) straight,
              Real known) HINGE_READS {
  Crossing crossing[label_limits];
  int dark[label_limits];
  int count = 0;
  for (int k = 0; k < HINGE_ROLLED(label_limits) && label.limit[k] != none; ++k) {
    HINGE_IN(Edge) e = reflex_edge(label.limit[k]);
    if (hides_point(e, see_edge(e, straight.eye), straight.eye, q, slack, crossing[count]))
      dark[count++] = k;
  }
  if (count == 0) return straight;
  FromEdge before = before_ring(label);
  Reach bent = straight;
  for (int i = 0; i < count; ++i) {
    Point b = point_on(reflex_edge(label.limit[dark[i]]), crossing[i].times / crossing[i].sum);
    Real way = reach(label, before, b).extent + norm(q - b);
    if (way > bent.extent || bent.bend < 0) {
      bent.eye = b;
      bent.extent = way;
      bent.bend = dark[i];
    }
    if (!(way < known)) return bent;
  }
  int k = bent.bend;
  // The way to the bend may be hidden itself, or the way on.
  Reach one = bent;
  for (int j = 0; j < HINGE_ROLLED(label_limits) && label.limit[j] != none; ++j) {
    if (j == k) continue;
    int first = j;
    int second = k;
    if (!hides(label.limit[j], straight.eye, one.eye)) {
      if (!hides(label.limit[j], one.eye, q)) continue;
      first = k;
      second = j;
    }
    Reach both = reach_by(label, straight.eye, first, second, q);
    if (both.extent > bent.extent) bent = both;
  }
  return bent;
}

HINGE_DO void clear_limits(HINGE_INOUT(Label) label) {
  for (int k = 0; k < label_limits; ++k) label.limit[k] = none;
}

/// Bends at a limit for good.
void turn(HINGE_INOUT(Label) label, int limit, HINGE_IN(Point) q) HINGE_READS {
  Index edge = label.limit[limit];
  if (label.ring != none) {
    // If the edges are parallel, S turns about the old ring until it lies in line with the way to
    // the new one: exact. Else the bend becomes the source.
    HINGE_IN(Edge) ring = reflex_edge(label.ring);
    Point c = reach_by(label, reach(label, q).eye, limit, q).eye;
    Point b = bend_point(ring, label.source, c);
    Real walked = norm(b - label.source);
    Real on = norm(c - b);
    Real at = dot(b - ring.end[0], ring.direction);
    if (parallel(ring, reflex_edge(edge)) && at > Real(0) && at < ring.extent && on > Real(0)) {
      label.source = b + walked / on * (b - c);
    } else {
      label.sigma += walked;
      label.source = b;
    }
  }
  label.path = bent_path(label.path, edge);
  label.ring = edge;
  for (int k = 0; k + 1 < label_limits; ++k)
    if (k >= limit) label.limit[k] = label.limit[k + 1];
  label.limit[label_limits - 1] = none;
}

bool hides_all(Index edge, HINGE_IN(Point) eye, HINGE_IN(Point) a, HINGE_IN(Point) b,
               HINGE_IN(Point) c) HINGE_READS {
  EdgeSight seen = see_edge(reflex_edge(edge), eye);
  Real angle2 = Real(1e-8);
  return !lights(seen, eye, a, angle2) && !lights(seen, eye, b, angle2) &&
         !lights(seen, eye, c, angle2);
}
