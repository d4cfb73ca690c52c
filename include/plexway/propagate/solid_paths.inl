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

/// The same with a bend at one limit: exact after a point.
Reach reach_by(HINGE_IN(Label) label, HINGE_IN(Point) eye, int limit,
               HINGE_IN(Point) q) HINGE_READS {
  Point b = bend_point(reflex_edge(label.limit[limit]), eye, q);
  Reach there = {b, way_to(label, b) + norm(q - b), limit};
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
  // What hides a part of that way is another bend, before or behind, if it makes the way longer: a
  // string pulled taut. `at` are its bends, from the eye before them to q behind them.
  int chain[label_limits];
  Point at[label_limits + 2];
  Point trial[label_limits + 2];
  int bends = 1;
  chain[0] = bent.bend;
  at[0] = straight.eye;
  at[1] = bent.eye;
  at[2] = q;
  int misses = 0;  // since the last one that was put in
  int j = 0;
  while (misses < HINGE_ROLLED(label_limits) && bends < label_limits) {
    if (j == label_limits || label.limit[j] == none) {
      misses += label_limits - j;
      j = 0;
      continue;
    }
    int place = -1;
    for (int i = 0; i < HINGE_ROLLED(bends); ++i)
      if (chain[i] == j) place = -2;
    for (int i = 0; i <= HINGE_ROLLED(bends); ++i)
      if (place == -1 && hides(label.limit[j], at[i], at[i + 1])) place = i;
    Real way = Real(0);
    if (place >= 0) {
      for (int n = 0; n <= HINGE_ROLLED(bends) + 1; ++n) trial[n <= place ? n : n + 1] = at[n];
      trial[place + 1] = at[place];
      for (int n = 0; n < HINGE_ROLLED(2) * (bends + 1); ++n) {
        int k = n <= bends ? n : n - bends - 1;
        int bend = k < place ? chain[k] : j;
        if (k > place) bend = chain[k - 1];
        trial[k + 1] = bend_point(reflex_edge(label.limit[bend]), trial[k], trial[k + 2]);
      }
      way = way_to(label, trial[1]);
      for (int n = 1; n <= HINGE_ROLLED(bends) + 1; ++n) way += norm(trial[n + 1] - trial[n]);
    }
    if (way > bent.extent) {
      // Counting up: of a loop with n from bends down, Mesa 22.3 loses what it stores.
      for (int n = 0; n < HINGE_ROLLED(bends) - place; ++n) chain[bends - n] = chain[bends - n - 1];
      chain[place] = j;
      ++bends;
      for (int n = 0; n <= HINGE_ROLLED(bends) + 1; ++n) at[n] = trial[n];
      bent.extent = way;
      misses = 0;
      j = 0;
    } else {
      ++misses;
      ++j;
    }
  }
  bent.eye = at[bends];
  bent.bend = chain[0];
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
