// The plain step between simplices of dimension K + 1 that share a facet: one text for C++ (part of
// the body of PlainSimplexRule, see simplex_rule.hpp) and GLSL, after that of the hinge kernel.
// Before it stand
//   Label                        distance2[K + 2], sigma, centre: see SimplexLabel
//   vertex_of(s, i)              corner i of simplex s
//   corner_beyond(s, facet, n, t, i)  the corner of s that is corner i of t, which is corner n of
//                                the facet between them in the order of t
//   squared_edge(s, e)           of its edges (0,1) (0,2) (1,2) (0,3) (1,3) (2,3) ...
//   edge_between(i, j)           the number of such an edge
//   facet_tolerance              lines may miss by so much of a facet: in a grid they pass exactly
//                                through its boundary
//   bend_penalty                 a bend's way is longer by more than rounding: of two paths of one
//                                length the straight one wins

/// Distance of the centre by a label. Leibniz: the mean squared distance from the corners less that
/// of the centroid.
HINGE_METHOD Real centre_distance(Index s, HINGE_IN(Label) label) HINGE_READS {
  const Real share = Real(1) / Real(K + 2);
  HINGE_PRECISE Real mean = Real(0);
  HINGE_PRECISE Real edges = Real(0);
  for (int i = 0; i < K + 2; ++i) mean += share * label.distance2[i];
  for (int e = 0; e < (K + 1) * (K + 2) / 2; ++e) edges += squared_edge(s, Index(e));
  HINGE_PRECISE Real square = mean - share * share * edges;
  HINGE_PRECISE Real far = label.sigma + sqrt(max(square, Real(0)));
  return far;
}

/// The facet between two simplices, posed, with the label's source and the apex of the one that is
/// entered. `here` and `there` are its corners in both, of a triangle the first an end of its
/// shortest edge, as poses like.
struct PlainHinge {
  HingePose pose;
  HingePoint source;
  HingePoint tip;
  Index here[K + 1];
  Index there[K + 1];
};

/// Corner i of s, seen from the facet.
HINGE_METHOD HingePoint off_facet(HINGE_IN(HingePose) pose, Index s, const Index corner[K + 1],
                                  Index i) HINGE_READS {
  Real off2[K + 1];
  for (int k = 0; k <= K; ++k) off2[k] = squared_edge(s, edge_between(corner[k], i));
  return locate(pose, off2);
}

HINGE_METHOD PlainHinge pose_facet(HINGE_IN(Label) from, Index s, Index facet, Index t,
                                   Index apex) HINGE_READS {
  PlainHinge hinge;
  int n = 0;
  for (int i = 0; i < K + 2; ++i)
    if (Index(i) != apex) {
      hinge.there[n] = Index(i);
      hinge.here[n] = corner_beyond(s, facet, Index(n), t, Index(i));
      ++n;
    }
  Real facet2[KE];
  facet2[0] = Real(0);
  for (int b = 1; b <= K; ++b)
    for (int a = 0; a < K; ++a)
      if (a < b)
        facet2[b * (b - 1) / 2 + a] = squared_edge(t, edge_between(hinge.there[a], hinge.there[b]));
  if (K == 2)
    if (facet2[KE - 1] < min(facet2[0], facet2[K / 2])) {
      Index kept = hinge.there[0];
      hinge.there[0] = hinge.there[K];
      hinge.there[K] = kept;
      kept = hinge.here[0];
      hinge.here[0] = hinge.here[K];
      hinge.here[K] = kept;
      Real other = facet2[0];
      facet2[0] = facet2[KE - 1];
      facet2[KE - 1] = other;
    }
  hinge.pose = make_pose(facet2);
  Real source2[K + 1];
  for (int i = 0; i <= K; ++i) source2[i] = from.distance2[hinge.here[i]];
  hinge.source = locate(hinge.pose, source2);
  hinge.tip = off_facet(hinge.pose, t, hinge.there, apex);
  return hinge;
}

/// What the label of s offers to t straight, through the facet or past it: no bend makes it
/// shorter.
HINGE_METHOD Label offer_straight(HINGE_IN(Label) from, HINGE_IN(PlainHinge) hinge, Index t,
                                  Index apex) HINGE_READS {
  Label label;
  for (int i = 0; i <= K; ++i) label.distance2[hinge.there[i]] = from.distance2[hinge.here[i]];
  label.distance2[apex] = distance_squared(hinge.pose, hinge.source, hinge.tip);
  label.sigma = from.sigma;
  label.centre = centre_distance(t, label);
  return label;
}

/// What it offers: `straight` where the line to the centre of t passes the facet or, with
/// `to_apex`, the one to its apex; else a bend on the facet. Its own source is in s (`inside`) or
/// passed it.
HINGE_METHOD Label offer_seen(HINGE_IN(Label) from, HINGE_IN(Label) straight,
                              HINGE_IN(PlainHinge) hinge, Index s, Index facet, Index t, Index apex,
                              bool inside, bool to_apex) HINGE_READS {
  HingePoint back = off_facet(hinge.pose, s, hinge.here, facet);
  bool is_behind =
      !inside && behind(hinge.pose, hinge.source, back, from.distance2[facet]) > Real(0);
  HINGE_PRECISE HingePoint probe = hinge.tip;
  if (!to_apex) {
    const Real share = Real(1) / Real(K + 2);
    for (int j = 0; j < K; ++j) {
      HINGE_PRECISE Real sum = hinge.tip.x[j];
      for (int i = 0; i <= K; ++i) sum += vertex_point(hinge.pose, i).x[j];
      probe.x[j] = share * sum;
    }
    probe.h = share * hinge.tip.h;
  }
  HingeStep step = carry(hinge.pose, hinge.source, from.sigma, probe, is_behind, facet_tolerance);
  Label label = straight;
  if (step.visible) return label;
  for (int i = 0; i <= K; ++i)
    label.distance2[hinge.there[i]] =
        distance_squared(hinge.pose, step.source, vertex_point(hinge.pose, i));
  label.distance2[apex] = distance_squared(hinge.pose, step.source, hinge.tip);
  HINGE_PRECISE Real walked = from.sigma + (step.sigma - from.sigma) * bend_penalty;
  label.sigma = walked;
  label.centre = centre_distance(t, label);
  return label;
}

HINGE_METHOD Label offer_plain(HINGE_IN(Label) from, Index s, Index facet, Index t, Index apex,
                               bool inside, bool to_apex) HINGE_READS {
  PlainHinge hinge = pose_facet(from, s, facet, t, apex);
  Label straight = offer_straight(from, hinge, t, apex);
  return offer_seen(from, straight, hinge, s, facet, t, apex, inside, to_apex);
}
