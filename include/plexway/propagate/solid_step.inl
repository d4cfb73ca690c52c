// The step of Visibility::saddles in solids, from a tetrahedron to a face neighbour, and the
// distance of a corner: one text for C++ (part of the body of SolidRule, see solid_rule.hpp) and
// GLSL, after solid_paths.inl. Before it stand also, for tetrahedra t by number,
//   centre_of(t), corner_of(t, i)    points
//   face_corner(t, face, k)          corners of a face, anticlockwise as seen from outside
//   neighbour(t, i)                  over face i, or no_tet()
//   first_reflex(t), reflex_entry(e), entry_edge(entry), entry_is_last(entry)
//   any_reflex(), own_rings()        are there reflex edges; which rings hide something: below it
//   reached(t), label_of(t)          what is known. Where labels change meanwhile, one may be read
//                                    half old, half new: only its edges and its name are used, and
//                                    an edge that is none of the scene's hides nothing that matters
//   same_limits(label, label), name_of(point, sigma)

HINGE_CONST Real face_tolerance = Real(0.1);

/// Squared distance of q from the virtual source. A ring's way is longer than the straight one.
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

/// Longest way worth comparing with from the centre of t over face i to the next centre: through
/// the face's centroid.
Real way(Index t, Index i) HINGE_READS {
  Point middle = Real(1) / Real(3) * face_corner(t, i, 0u);
  middle = middle + Real(1) / Real(3) * face_corner(t, i, 1u);
  middle = middle + Real(1) / Real(3) * face_corner(t, i, 2u);
  return norm(middle - centre_of(t)) + norm(centre_of(neighbour(t, i)) - middle);
}

/// Is there an edge at t that hides q?
bool own_hides(HINGE_IN(Label) from, Index t, HINGE_IN(Point) eye, HINGE_IN(Point) q) HINGE_READS {
  Index e = first_reflex(t);
  if (e == none) return false;
  for (;; ++e) {
    Index entry = reflex_entry(e);
    Index edge = entry_edge(entry);
    if (edge != from.ring && hides(edge, eye, q)) return true;
    if (entry_is_last(entry)) break;
  }
  return false;
}

/// In t's memory, or at t?
bool may_bend(HINGE_IN(Label) from, Index t, HINGE_IN(Point) eye, HINGE_IN(Point) q) HINGE_READS {
  for (int k = 0; k < HINGE_ROLLED(label_limits); ++k) {
    if (from.limit[k] == none) break;
    if (hides(from.limit[k], eye, q)) return true;
  }
  return own_hides(from, t, eye, q);
}

HINGE_CONST int most_candidates = 32;
struct Candidates {
  Index edge[most_candidates];
  int count;
};

HINGE_DO void add_candidate(HINGE_INOUT(Candidates) found, Index edge, Index except) {
  if (edge == except || found.count == most_candidates) return;
  for (int i = 0; i < found.count; ++i)
    if (found.edge[i] == edge) return;
  found.edge[found.count++] = edge;
}

/// Chooses which edges the label remembers for q in u: its own, those of t, and those of neighbours
/// of u that look at the same scene. u may be no_tet().
void gather(Index t, Index u, HINGE_INOUT(Label) label, HINGE_IN(Point) q,
            HINGE_INOUT(Reach) straight) HINGE_READS {
  Candidates found;
  found.count = 0;
  for (int k = 0; k < label_limits; ++k) {
    if (label.limit[k] == none) break;
    found.edge[found.count++] = label.limit[k];
  }
  int own = found.count;
  Index e = first_reflex(t);
  if (e != none)
    for (;; ++e) {
      Index entry = reflex_entry(e);
      add_candidate(found, entry_edge(entry), label.ring);
      if (entry_is_last(entry)) break;
    }
  if (u != no_tet())
    for (int i = 0; i < HINGE_ROLLED(4); ++i) {
      Index v = neighbour(u, Index(i));
      if (v == t || v == no_tet() || !reached(v)) continue;
      HINGE_IN(Label) other = label_of(v);
      if (other.path == label.path) {
        if (!same_limits(other, label))
          for (int k = 0; k < HINGE_ROLLED(label_limits); ++k) {
            if (other.limit[k] == none) break;
            add_candidate(found, other.limit[k], label.ring);
          }
      } else if (other.ring < own_rings() && path_before(other.path, other.ring) == label.path) {
        add_candidate(found, other.ring, label.ring);
      }
    }
  if (found.count == own) return;
  // An edge that hides the ring itself comes before it.
  if (label.ring < own_rings())
    for (int i = own; i < found.count; ++i) {
      Index edge = found.edge[i];
      if (!hides(edge, label.source, straight.eye)) continue;
      label.path = bent_path(path_before(label.path, label.ring), edge);
      found.edge[i] = label.ring;
      label.ring = edge;
      straight = reach(label, q);
    }
  if (found.count <= label_limits) {
    for (int i = own; i < found.count; ++i) label.limit[i] = found.edge[i];
    return;
  }
  // The one that hides q most closely comes first; what else is in the way is so from that bend.
  Point eye = straight.eye;
  Index bend = none;
  Real closest = HINGE_INFINITY;
  for (int i = 0; i < found.count; ++i) {
    Index edge = found.edge[i];
    HINGE_IN(Edge) reflex = reflex_edge(edge);
    EdgeSight seen = see_edge(reflex, eye);
    Crossing unused;
    if (edge == label.ring || !hides_point(reflex, seen, eye, q, slack, unused)) continue;
    Real close2 = rank_edge(reflex, seen, eye, q, slack, HINGE_INFINITY).closeness;
    if (close2 < closest) {
      closest = close2;
      bend = edge;
    }
  }
  clear_limits(label);
  int first = 0;
  if (bend != none) {
    label.limit[0] = bend;
    eye = bend_point(reflex_edge(bend), eye, q);
    first = 1;
  }
  // Then the nearest, and before them those that hide q.
  int count = first;
  Real key[label_limits];
  for (int i = 0; i < found.count; ++i) {
    Index edge = found.edge[i];
    if (edge == label.ring || edge == bend) continue;
    HINGE_IN(Edge) reflex = reflex_edge(edge);
    SightRank rank = rank_edge(reflex, see_edge(reflex, eye), eye, q, slack,
                               count < label_limits ? HINGE_INFINITY : key[label_limits - 1]);
    if (!(rank.closeness < HINGE_INFINITY)) continue;
    Real k = rank.dark ? Real(-1) / (Real(1) + rank.closeness) : rank.closeness;
    int place = count < label_limits ? count++ : label_limits;
    for (; place > first && k < key[place - 1]; --place)
      if (place < label_limits) {
        key[place] = key[place - 1];
        label.limit[place] = label.limit[place - 1];
      }
    if (place < label_limits) {
      key[place] = k;
      label.limit[place] = edge;
    }
  }
}

/// When its turn comes, a label with room asks the neighbours again: some were reached since. Its
/// distance stays, even if its centre turns out to lie in shadow. True if it heard of anything.
bool hears(Index t, HINGE_INOUT(Label) label) HINGE_READS {
  if (!any_reflex() || label.limit[label_limits - 1] != none) return false;
  Label before = label;
  Reach path = reach(label, centre_of(t));
  gather(t, t, label, centre_of(t), path);
  return before.ring != label.ring || !same_limits(before, label);
}

/// No straight line: over the best point of the face's edges.
void bend_anywhere(HINGE_INOUT(Label) label, HINGE_INOUT(Reach) path, HINGE_IN(Point) q,
                   HINGE_IN(Point) a, HINGE_IN(Point) b, HINGE_IN(Point) c) HINGE_READS {
  Real best = HINGE_INFINITY;
  Point at = a;
  Real walked = Real(0);
  Point first = a;
  Point second = b;
  Point third = c;
  for (int i = 0; i < HINGE_ROLLED(3); ++i) {
    Point p = bend_point(first, second, path.eye, q);
    Point next = second;
    second = third;
    third = first;
    first = next;
    Real w = norm(p - path.eye);
    Real d = w + norm(q - p);
    if (d < best) {
      best = d;
      at = p;
      walked = w;
    }
  }
  walked += path.extent - norm(q - path.eye);
  label.source = at;
  label.sigma = walked;
  label.ring = none;
  clear_limits(label);
  label.path = name_of(at, walked);
  path.eye = at;
  path.extent = walked + norm(q - at);
  path.bend = -1;
}

/// The full rule: what t offers to u over a face, if it is below `known`. `last_resort`: bends on
/// the face rather than drop the offer.
HINGE_FAST bool offer_bent(HINGE_IN(Label) from, Index t, Index face, Index u, Real known,
                           bool last_resort, HINGE_INOUT(Label) label) HINGE_READS {
  Point q = centre_of(u);
  Reach path = reach(from, q);
  if (!(path.extent < known)) return false;
  HINGE_IN(Point) a = face_corner(t, face, 0u);
  HINGE_IN(Point) b = face_corner(t, face, 1u);
  HINGE_IN(Point) c = face_corner(t, face, 2u);
  bool through = passes(path.eye, q, a, b, c, face_tolerance);
  // A line that misses the face passes it if it bends at an edge known here.
  if (!through && !last_resort && !may_bend(from, t, path.eye, q)) return false;
  label = from;
  gather(t, u, label, q, path);
  if (label.limit[0] != none || label.ring != from.ring) {
    Real within = known;
    for (int bends = 0; bends < HINGE_ROLLED(2); ++bends) {
      Point eye = path.eye;
      path = measure(label, q, path, within);
      if (bends == 1) break;
      if (!(path.extent < known)) return false;
      if (path.bend < 0 || !hides_all(label.limit[path.bend], eye, a, b, c)) break;
      turn(label, path.bend, q);
      path = reach(label, q);
      within = HINGE_INFINITY;
    }
  }
  bool same = path.bend < 0 && label.ring == from.ring;
  if (!(same ? through : passes(path.eye, q, a, b, c, face_tolerance))) {
    if (!last_resort) return false;
    bend_anywhere(label, path, q, a, b, c);
  }
  if (!(path.extent < known)) return false;
  label.centre = path.extent;
  return true;
}

/// Length of the path to a point of a reached tetrahedron, as far as it is below `known`.
HINGE_FAST Real reach_at(HINGE_IN(Label) from, Index t, HINGE_IN(Point) q, Real known) HINGE_READS {
  Real straight = from.sigma + norm(q - from.source);
  if (!any_reflex() || !(straight < known)) return straight;
  Reach simple = reach(from, q);
  if (!(simple.extent < known)) return simple.extent;
  Label label = from;
  if (first_reflex(t) != none) gather(t, no_tet(), label, q, simple);
  return measure(label, q, simple, known).extent;
}
/// To its corner i.
HINGE_FAST Real corner_reach(HINGE_IN(Label) from, Index t, Index i, Real known) HINGE_READS {
  return reach_at(from, t, corner_of(t, i), known);
}
