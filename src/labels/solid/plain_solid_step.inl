// The plain step in solids, from a tetrahedron to a face neighbour: one text for C++ (part of the
// body of PlainSolidRule, see plain_solid_rule.hpp) and GLSL, after that of the K = 2 hinge kernel.
// Before it stand
//   Label                        distance2[4], sigma, centre: see PlainSolidLabel
//   vertex_of(t, i)              corner i of tetrahedron t
//   squared_edge(t, e)           of its edges (0,1) (0,2) (1,2) (0,3) (1,3) (2,3)
//   tet_edge(i, j)               the number of such an edge
//   face_tolerance               lines may miss by so much of a face: in a grid they pass exactly
//                                through edges and corners of faces
//   bend_penalty                 a bend's way is longer by more than rounding: of two paths of one
//                                length the straight one wins

/// Distance of the centre by a label. Leibniz: the mean squared distance from the corners less that
/// of the centroid.
HINGE_METHOD Real centre_distance(Index t, HINGE_IN(Label) label) HINGE_READS {
  HINGE_PRECISE Real mean = Real(0);
  HINGE_PRECISE Real edges = Real(0);
  for (int i = 0; i < 4; ++i) mean += Real(0.25) * label.distance2[i];
  for (int e = 0; e < 6; ++e) edges += squared_edge(t, Index(e));
  HINGE_PRECISE Real square = mean - Real(0.0625) * edges;
  HINGE_PRECISE Real far = label.sigma + sqrt(max(square, Real(0)));
  return far;
}

HINGE_METHOD Index corner_of(Index t, Index vertex) HINGE_READS {
  Index i = Index(0);
  while (vertex_of(t, i) != vertex) ++i;
  return i;
}

/// The face between two tetrahedra, posed, with the label's source. `here` and `there` are its
/// corners in both, the first an end of its shortest edge, as poses like.
struct SolidHinge {
  HingePose pose;
  HingePoint source;
  Index here[3];
  Index there[3];
};

HINGE_METHOD SolidHinge pose_face(HINGE_IN(Label) from, Index t, Index u, Index apex) HINGE_READS {
  SolidHinge hinge;
  int n = 0;
  for (int i = 0; i < 4; ++i)
    if (Index(i) != apex) {
      hinge.there[n] = Index(i);
      hinge.here[n] = corner_of(t, vertex_of(u, Index(i)));
      ++n;
    }
  Real first = squared_edge(u, tet_edge(hinge.there[0], hinge.there[1]));
  Real second = squared_edge(u, tet_edge(hinge.there[0], hinge.there[2]));
  Real third = squared_edge(u, tet_edge(hinge.there[1], hinge.there[2]));
  if (third < min(first, second)) {
    Index kept = hinge.there[0];
    hinge.there[0] = hinge.there[2];
    hinge.there[2] = kept;
    kept = hinge.here[0];
    hinge.here[0] = hinge.here[2];
    hinge.here[2] = kept;
    Real other = first;
    first = third;
    third = other;
  }
  Real face2[KE];
  face2[0] = first;
  face2[1] = second;
  face2[2] = third;
  hinge.pose = make_pose(face2);
  Real source2[K + 1];
  for (int i = 0; i < 3; ++i) source2[i] = from.distance2[hinge.here[i]];
  hinge.source = locate(hinge.pose, source2);
  return hinge;
}

/// Corner i of t, seen from the face.
HINGE_METHOD HingePoint off_face(HINGE_IN(HingePose) pose, Index t, const Index corner[3],
                                 Index i) HINGE_READS {
  Real off2[K + 1];
  for (int k = 0; k < 3; ++k) off2[k] = squared_edge(t, tet_edge(corner[k], i));
  return locate(pose, off2);
}

/// What the label of t offers to u over a face; its own source is in t (`inside`) or passed it.
/// Seen is what the line to the centre of u passes the face to, or, with `to_apex`, to its apex.
HINGE_METHOD Label offer_plain(HINGE_IN(Label) from, Index t, Index face, Index u, Index apex,
                               bool inside, bool to_apex) HINGE_READS {
  SolidHinge hinge = pose_face(from, t, u, apex);
  HingePoint back = off_face(hinge.pose, t, hinge.here, face);
  bool is_behind =
      !inside && behind(hinge.pose, hinge.source, back, from.distance2[face]) > Real(0);
  HingePoint tip = off_face(hinge.pose, u, hinge.there, apex);
  HINGE_PRECISE HingePoint probe = tip;
  if (!to_apex) {
    for (int j = 0; j < 2; ++j) {
      HINGE_PRECISE Real sum = tip.x[j];
      for (int i = 0; i < 3; ++i) sum += vertex_point(hinge.pose, i).x[j];
      probe.x[j] = Real(0.25) * sum;
    }
    probe.h = Real(0.25) * tip.h;
  }
  HingeStep step = carry(hinge.pose, hinge.source, from.sigma, probe, is_behind, face_tolerance);
  Label label;
  for (int i = 0; i < 3; ++i)
    label.distance2[hinge.there[i]] =
        step.visible ? from.distance2[hinge.here[i]]
                     : distance_squared(hinge.pose, step.source, vertex_point(hinge.pose, i));
  label.distance2[apex] = distance_squared(hinge.pose, step.source, tip);
  HINGE_PRECISE Real walked = from.sigma + (step.sigma - from.sigma) * bend_penalty;
  label.sigma = step.visible ? step.sigma : walked;
  label.centre = centre_distance(u, label);
  return label;
}
