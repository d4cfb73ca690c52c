// The step of Visibility::saddles in solids, from a tetrahedron to a face neighbour, and the
// distance of a point: one text for C++ (part of the body of SolidRule, see solid_rule.hpp) and
// GLSL, after solid_walk.inl. Before it stand also
//   first_reflex(t), reflex_entry(e), entry_edge(entry), entry_is_last(entry)
//   any_reflex()                     are there reflex edges
//   any_cracks()                     and faces of the boundary that lie on each other
//   reached(t), label_of(t)          what is known
//   same_way(label, label)           do they have the same S and bends?

HINGE_CONST Real face_tolerance = Real(0.1);

/// Squared distance of q from the virtual source. No bend makes a way shorter.
HINGE_FN Real straight_squared(HINGE_IN(Label) label, HINGE_IN(Point) q) {
  Point g = q - label.source;
  return dot(g, g);
}
HINGE_FN bool may_beat(HINGE_IN(Label) label, Real straight2, Real known) {
  Real left = known - label.sigma;
  return left > Real(0) && straight2 < left * left;
}

HINGE_METHOD bool passes_face(HINGE_IN(Point) eye, HINGE_IN(Point) q, Index t,
                              Index face) HINGE_READS {
  return passes(eye, q, face_corner(t, face, 0u), face_corner(t, face, 1u),
                face_corner(t, face, 2u), face_tolerance);
}

/// Where nothing bends a path: the label as it is, if the line to q passes the face.
HINGE_METHOD bool offer_straight(HINGE_IN(Label) from, Index t, Index face, HINGE_IN(Point) q,
                                 HINGE_INOUT(Label) label) HINGE_READS {
  if (!passes_face(from.source, q, t, face)) return false;
  label = from;
  label.centre = from.sigma + norm(q - from.source);
  return true;
}

HINGE_METHOD Point face_middle(Index t, Index face) HINGE_READS {
  Point middle = Real(1) / Real(3) * face_corner(t, face, 0u);
  middle = middle + Real(1) / Real(3) * face_corner(t, face, 1u);
  middle = middle + Real(1) / Real(3) * face_corner(t, face, 2u);
  return middle;
}
/// Longest way worth comparing with from the centre of t over face i to the next centre: through
/// the face's centroid.
Real way(Index t, Index i) HINGE_READS {
  Point middle = face_middle(t, i);
  return norm(middle - centre_of(t)) + norm(centre_of(neighbour(t, i)) - middle);
}

/// A bend as lines are walked to it: a little off the edge and from its ends, into the solid.
HINGE_METHOD Point beside(HINGE_IN(Edge) e, HINGE_IN(Point) bend) HINGE_READS {
  Real off = nudge * min(e.extent, Real(1));
  Real along = dot(bend - e.end[0], e.direction);
  return e.end[0] + clamp(along, off, e.extent - off) * e.direction + off * e.solid;
}

/// Where a leg to or from a bend is walked to, if `other` is where the string is on the other side
/// of it. At the end of a crack it comes along one face and goes along the other one, or it would
/// not bend: there it is walked on the side where `other` is not.
HINGE_METHOD Point beside(HINGE_IN(Edge) e, HINGE_IN(Point) bend,
                          HINGE_IN(Point) other) HINGE_READS {
  Point at = beside(e, bend);
  if (HINGE_LIKELY(!is_cracks(e))) return at;
  Point way = other - e.end[0];
  Real height = dot(way, e.normal[0]);
  if (!(abs(height) > in_crack * norm(way))) return at;
  Real off = nudge * min(e.extent, Real(1));
  return at + (height > Real(0) ? -off : off) * e.normal[0];
}

/// A point q of u's boundary as strings are walked from it.
HINGE_METHOD Point within(Index u, HINGE_IN(Point) q) HINGE_READS {
  return q + nudge * (centre_of(u) - q);
}

/// Walks the string back from its end, seen as `end` in tetrahedron u, to the source.
bool is_free(HINGE_IN(Taut) s, HINGE_IN(Label) label, Index u, HINGE_IN(Point) end,
             HINGE_INOUT(Hit) hit) HINGE_READS {
  Point from = end;
  hit.tet = u;
  hit.leg = s.bends;
  for (int n = 0; n <= HINGE_ROLLED(s.bends); ++n) {
    hit.leg = s.bends - n;
    Point to = s.at[hit.leg];
    Point turn = to;  // at the end of a crack: and on from there
    bool turns = false;
    bool last = hit.leg == 0;
    if (hit.leg > 0) {
      // What lies before a further edge is not of this solid.
      Index edge = s.edge[max(hit.leg, 1) - 1];
      last = edge >= own_edges();
      if (!last) {
        HINGE_IN(Edge) e = reflex_edge(edge);
        turns = is_cracks(e);
        turn = beside(e, to, hit.leg == s.bends ? end : s.at[hit.leg + 1]);
        to = beside(e, to, s.at[max(hit.leg, 1) - 1]);
      }
    } else if (is_unfolded(label)) {
      // What is before the edge that S was turned about was walked when it was.
      HINGE_IN(Edge) e = reflex_edge(label.door - unfolded_door);
      FromEdge source = from_edge(e, s.at[0]);
      FromEdge bend = from_edge(e, s.at[1]);
      Real along = crossing_along(source, bend);
      if (!(along >= Real(0) && along <= e.extent)) return false;
      to = beside(e, point_on(e, along));
    } else if (HINGE_RARE(begins_beside(label))) {
      to = within(label.door - beside_door, to);
    }
    for (int stop = 0; stop < HINGE_ROLLED(2); ++stop) {
      if (!walk(hit.tet, from, to)) return hit.leg == 0 && comes_in(label, hit.tet);
      from = to;
      if (last || !turns) break;
      to = turn;
    }
    if (last) break;
  }
  return true;
}

/// Lines are walked a little beside strings, so edges that strings only touch may be in the way:
/// those around which the detour is no longer than this.
HINGE_CONST Real touch = Real(1e-3) * nudge;

/// Which reflex edge at the place where a leg left the solid is in its way: the one around which
/// the detour is least; where none is, one that the leg only touches. none: none there. `inside`:
/// not where the way bends at the edge's end.
Index edge_in_the_way(HINGE_IN(Taut) s, HINGE_IN(Hit) hit, bool inside) HINGE_READS {
  Index e = first_reflex(hit.tet);
  if (e == none) return none;
  Point p = s.at[hit.leg];
  Point q = s.at[hit.leg + 1];
  Index found = none;
  Real least = HINGE_INFINITY;
  bool any_presses = false;
  Real touches = norm(q - p) + touch;
  for (;; ++e) {
    Index entry = reflex_entry(e);
    Index edge = entry_edge(entry);
    bool there = (hit.leg > 0 && s.edge[max(hit.leg, 1) - 1] == edge) ||
                 (hit.leg < s.bends && s.edge[hit.leg] == edge);
    if (!there) {
      HINGE_IN(Edge) reflex = reflex_edge(edge);
      Point b = bend_point(reflex, p, q);
      Real before = norm(b - p);
      Real behind = norm(q - b);
      Real detour = before + behind;
      bool in_the_way = presses(reflex, p, q);
      bool better = detour < least;
      if (in_the_way != any_presses) better = in_the_way;
      // An edge that begins at p or q is not in the way.
      if (better && (in_the_way || detour < touches) && min(before, behind) > Real(1e-2) * nudge &&
          !(inside && at_an_end(reflex, b))) {
        any_presses = in_the_way;
        least = detour;
        found = edge;
      }
    }
    if (entry_is_last(entry)) break;
  }
  return found;
}

void put_in(HINGE_INOUT(Taut) s, int place, Index edge) HINGE_READS {
  Point end = s.at[s.bends + 1];
  for (int n = 0; n < HINGE_ROLLED(s.bends); ++n) {
    int i = s.bends - n;
    if (i > place) s.edge[i] = s.edge[i - 1];
  }
  s.edge[place] = edge;
  ++s.bends;
  s.at[s.bends + 1] = end;
}

bool bends_at(HINGE_IN(Taut) s, Index edge) HINGE_READS {
  for (int i = 0; i < HINGE_ROLLED(s.bends); ++i)
    if (s.edge[i] == edge) return true;
  return false;
}

/// Puts an edge behind another one, or first.
void put_behind(HINGE_INOUT(Taut) s, Index before, Index edge) HINGE_READS {
  int place = 0;
  for (int i = 0; i < HINGE_ROLLED(s.bends); ++i)
    if (s.edge[i] == before) place = i + 1;
  if (s.bends < most_bends) put_in(s, place, edge);
}
HINGE_METHOD Index edge_before(HINGE_IN(Taut) s, int leg) HINGE_READS {
  if (leg == 0) return none;
  return s.edge[leg - 1];
}

HINGE_CONST int most_halvings = 8;
/// Strings from the end of a crack graze it: down to as far as they are walked beside it.
HINGE_CONST int most_at_cracks = 11;
/// Those that begin beside a place on a crack run along its face, and near its end from farther on.
HINGE_CONST int most_beside = 16;
HINGE_CONST int most_tries = 4;
// What find_taut tries: the label's own string, one to a point on the way, one that passes the ends
// of edges, one with a further edge, the same with no edge left out, and without a neighbour of
// that edge; where a string lifts off edges by no more than it may touch them, one around them all.
HINGE_CONST int own_string = 0;
HINGE_CONST int halved = 1;
HINGE_CONST int loose = 2;
HINGE_CONST int further = 3;
HINGE_CONST int touching = 4;
HINGE_CONST int thinned = 5;
HINGE_CONST int whole = 6;

/// The string of a label of t to a point of u, which is t or its neighbour over a face; `end` is
/// where it is walked from. False where it is not below `known`, or where what is in its way is not
/// found. A string that is free is a path; what it must still go around is found where it leaves
/// the solid, or, by halving, where it would do so first on the way from the centre of t, which it
/// reaches, over `middle`. `own`: where the label's own string is known to leave the solid, or
/// `nowhere`.
///
/// One loop that pulls and walks a string in one place each: shader compilers copy every call.
bool find_taut(HINGE_IN(Label) label, Index t, HINGE_IN(Point) middle, Index u, HINGE_IN(Point) end,
               HINGE_IN(Point) q, Real known, HINGE_IN(Hit) own, HINGE_INOUT(Taut) s) HINGE_READS {
  int kept = fixed_bends(label);
  s = edges_of(label, q);
  Taut all;   // the label's edges and the further ones, not pulled
  Taut base;  // the last string that was pulled and is not free
  Hit hit;
  Hit base_hit;
  int trying = own_string;
  int tries = 0;
  int halvings = 0;
  Index edge = none;
  Index from = u;
  Point start = end;
  Real low = Real(0);
  Real high = Real(2);
  Real bound = known;
  bool last = false;  // nothing else is left to try
  int most = any_cracks() ? most_at_cracks : most_halvings;
  if (begins_beside(label)) most = most_beside;
  for (int turn = 0; turn < HINGE_ROLLED(most_tries * (most_beside + 7)); ++turn) {
    int stay = kept;
    if (trying == touching || trying == whole) stay = s.bends;
    pull(s, label.sigma, stay, trying <= halved);
    if (trying == further && !bends_at(s, edge)) {
      // Only touched, or lifted off by the bends around it.
      bound = min(known, s.extent + touch);
      s = base;
      trying = touching;
      continue;
    }
    bool below = trying == halved || s.extent < bound;
    bool hidden = trying == own_string && own.tet != none;
    if (hidden) hit = own;
    if (below && !hidden && is_free(s, label, from, start, hit)) {
      if (trying != halved) return true;
      low = Real(0.5) * (low + high);
    } else {
      bool squeezed = trying == touching;
      bool inside = !last && trying != loose && !squeezed;
      bool look = true;
      if (squeezed) {
        look = below && tries < most_tries && s.bends < most_bends;
      } else if (trying == halved) {
        high = Real(0.5) * (low + high);
      } else if (trying != loose && trying != whole) {
        if (!below || tries == most_tries || s.bends == most_bends) return false;
        if (trying == own_string) all = edges_of(label, q);
        ++tries;
        base = s;
        base_hit = hit;
        low = Real(0);
        high = Real(2);
        halvings = 0;
        last = false;
      }
      bool pulled = trying == own_string || trying == loose;
      if (pulled && below && all.bends > s.bends) {
        // It lifts off some of the edges, perhaps by no more than rounding.
        bound = min(known, s.extent + touch);
        s = all;
        last = trying == loose;
        trying = whole;
        continue;
      }
      if (trying == loose) last = true;
      if (trying == loose || trying == whole) {
        s = base;
        hit = base_hit;
        bound = known;
      }
      Index before = edge_before(s, hit.leg);
      Index found = none;
      // A turned S sees nothing but the edge that it was turned to.
      if (look && !(hit.leg == 0 && is_unfolded(label))) found = edge_in_the_way(s, hit, inside);
      // One that the string on the way lifts off, and only touches: not what hides the end.
      if (trying == halved && found != none && bends_at(all, found)) found = none;
      if (squeezed) {
        if (found != none) {
          // Walked beside the one edge, it touches another one on the other side.
          ++tries;
          put_in(s, hit.leg, found);
          continue;
        }
        // One of the bends around the edge is not needed.
        bound = known;
        s = base;
        int place = 0;
        for (int i = 0; i < HINGE_ROLLED(s.bends); ++i)
          if (s.edge[i] == edge) place = i;
        if (place + 1 < s.bends)
          leave_out(s, place + 1);
        else if (place > kept)
          leave_out(s, place - 1);
        trying = thinned;
        continue;
      }
      edge = found;
      if (edge != none) {
        put_behind(all, before, edge);
        put_behind(base, before, edge);
        s = base;
        from = u;
        start = end;
        trying = further;
        continue;
      }
      if (last) return false;
    }
    // On the way there, then; or around the end of an edge.
    s = all;
    from = u;
    start = end;
    trying = halvings < most ? halved : loose;
    if (trying == halved) {
      ++halvings;
      Real at = Real(0.5) * (low + high);
      bool here = at < Real(1);
      if (here) {
        from = t;
        start = centre_of(t) + at * (middle - centre_of(t));
      } else {
        start = middle + (at - Real(1)) * (end - middle);
      }
      s.at[s.bends + 1] = start;
    }
  }
  return false;
}

/// Is the first edge of a free string seen from S all along, as far as lines over the second one
/// pass? `end` in u is where the string is walked from. Where the way is free at both ends of that
/// part and at the bend, it is taken to be so between.
bool sees_first_edge(HINGE_IN(Taut) s, HINGE_IN(Label) label, Index u,
                     HINGE_IN(Point) end) HINGE_READS {
  if (s.bends == most_bends) return false;
  HINGE_IN(Edge) e = reflex_edge(s.edge[0]);
  HINGE_IN(Edge) next = reflex_edge(s.edge[1]);
  FromEdge source = from_edge(e, s.at[0]);
  for (int n = 0; n < HINGE_ROLLED(2); ++n) {
    FromEdge beyond = from_edge(e, next.end[n]);
    Taut along = bent_along(s, point_on(e, crossing_along(source, beyond)));
    Hit hit;
    if (!is_free(along, label, u, end, hit)) return false;
  }
  return true;
}

/// Makes a label of a free string, walked from `end` in u. What is too long loses its first bends:
/// about an edge parallel to the next one S turns, which is exact, if it sees that edge; else the
/// bend becomes S.
void keep(HINGE_INOUT(Taut) s, HINGE_INOUT(Label) label, Index u, HINGE_IN(Point) end) HINGE_READS {
  for (int n = 0; n < HINGE_ROLLED(most_bends - label_bends); ++n) {
    if (s.bends <= label_bends) break;
    bool turns = may_turn(s, label) && sees_first_edge(s, label, u, end);
    leave_first(s, label, turns);
  }
  set_bends(s, label);
}

/// A virtual source in a tetrahedron, or on its boundary.
HINGE_DO void start_at(HINGE_INOUT(Label) label, HINGE_IN(Point) at, Real sigma,
                       HINGE_IN(Point) q) {
  label.source = at;
  label.sigma = sigma;
  label.door = none;
  clear_bends(label);
  label.centre = sigma + norm(q - at);
}

/// The full rule: what t offers to u over a face, if it is below `known`. `last_resort`: bends on
/// the face rather than drop the offer.
HINGE_FAST bool offer_bent(HINGE_IN(Label) from, Index t, Index face, Index u, Real known,
                           bool last_resort, HINGE_INOUT(Label) label) HINGE_READS {
  Point q = centre_of(u);
  // It has come the same way?
  if (!last_resort && reached(u) && same_way(from, label_of(u))) return false;
  Point over = face_middle(t, face);
  Point end = q;
  Index in_tet = u;
  // No other way: through the middle of the face.
  Point middle = over;
  Real sigma = from.centre + norm(middle - centre_of(t));
  Taut s;
  label = from;
  for (int n = 0; n < HINGE_ROLLED(2); ++n) {
    bool found = find_taut(from, t, over, in_tet, end, end, n == 0 ? known : sigma, nowhere(), s);
    if (found && n == 0) {
      keep(s, label, in_tet, end);
      return true;
    }
    if (!last_resort) return false;
    if (found) sigma = s.extent;
    over = centre_of(t);
    end = middle;
    in_tet = t;
  }
  start_at(label, middle, sigma, q);
  return label.centre < known;
}

/// Length of the path to a point of u, which is the reached tetrahedron t or has the point
/// `middle` with it, as far as it is below `known`; else no less than that.
HINGE_FAST Real reach_at(HINGE_IN(Label) from, Index t, HINGE_IN(Point) middle, Index u,
                         HINGE_IN(Point) q, Real known, HINGE_IN(Hit) own) HINGE_READS {
  Real straight = from.sigma + norm(q - from.source);
  if (!any_reflex() || !(straight < known)) return straight;
  Taut s;
  if (find_taut(from, t, middle, u, within(u, q), q, known, own, s)) return s.extent;
  if (t != u) return HINGE_INFINITY;
  return from.centre + norm(q - centre_of(t));
}
/// To its corner i.
HINGE_FAST Real corner_reach(HINGE_IN(Label) from, Index t, Index i, Real known,
                             HINGE_IN(Hit) own) HINGE_READS {
  return reach_at(from, t, centre_of(t), t, corner_of(t, i), known, own);
}
/// The same by the label's own string alone. `own`: where that leaves the solid if it is below
/// `known`, but not free.
HINGE_FAST Real corner_sight(HINGE_IN(Label) from, Index t, Index i, Real known,
                             HINGE_INOUT(Hit) own) HINGE_READS {
  Point q = corner_of(t, i);
  own = nowhere();
  Real straight = from.sigma + norm(q - from.source);
  if (!any_reflex() || !(straight < known)) return straight;
  Taut s = taut_to(from, q);
  Hit hit;
  if (!(s.extent < known) || is_free(s, from, t, within(t, q), hit)) return s.extent;
  own = hit;
  return s.extent;
}
