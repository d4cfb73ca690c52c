// The step of Visibility::saddles: one text for C++ (the body of SaddleKernel<Real>, see
// saddle_step.hpp) and GLSL, after that of the K = 1 hinge kernel. It measures x in lengths: its
// pose has an axis of length 1.
//
// A label is a virtual source S with at most one limit on each side: the saddle that its line of
// sight passes most closely. What lies beyond a limit is in its shadow, where the path bends at
// that limit. S itself is given up for the limit only when a whole hinge lies in shadow: until
// then both the lit part and the shadow are known, which a label that bends as soon as one probe
// is in shadow (GSP 2021) cannot say.
//
// Signs of differences of products decide, and where both products are equal the sign must be
// neither: so those are HINGE_PRECISE.

/// A label under way to the next triangle: posed on the hinge between, plain numbers.
struct PosedSaddles {
  HingePoint source;
  HingePoint limit[2];  // left, right
  Real sigma;
};

/// The hinge as the triangle beyond sees it.
struct SaddleHinge {
  Real extent;      // its length
  HingePoint apex;  // of the triangle beyond
  bool saddle[2];   // may paths bend at the left, the right end?
  int pivot;        // 0 or 1: the end shared with the edge the path came in by, or -1 for neither
};

/// What `cross_hinge` found.
struct CrossedHinge {
  PosedSaddles label;
  Real distance;  // of the centre of the triangle beyond
};

HINGE_COLD HingePoint saddle_point(Real x, Real h) {
  HingePoint p;
  p.x[0] = x;
  p.h = h;
  return p;
}

/// Of two points on the same side.
HINGE_COLD Real gap(HINGE_IN(HingePoint) a, HINGE_IN(HingePoint) b) {
  return sqrt((a.x[0] - b.x[0]) * (a.x[0] - b.x[0]) + (a.h - b.h) * (a.h - b.h));
}

/// From S, is q (beyond the hinge) to the left of p (on S's side)? Positive if so.
HINGE_COLD Real left_of(HINGE_IN(HingePoint) S, HINGE_IN(HingePoint) p, HINGE_IN(HingePoint) q) {
  HINGE_PRECISE Real turn = (p.x[0] - S.x[0]) * (S.h + q.h) - (S.h - p.h) * (q.x[0] - S.x[0]);
  return turn;
}

/// What rounding may do to a coordinate of S posed on the hinge.
HINGE_COLD Real rounding(HINGE_IN(HingePoint) S, Real hinge) {
  return Real(64) * HINGE_EPSILON * (abs(S.x[0]) + abs(S.h) + hinge);
}

/// Does this limit hide the whole hinge? `turn` is its left_of for the hinge's far end, positive if
/// hidden. Where the limit is that very end, turn is 0 but for rounding, and all else is hidden.
HINGE_COLD bool hides_hinge(HINGE_IN(HingePoint) S, HINGE_IN(HingePoint) limit, Real hinge,
                            Real turn) {
  return turn > -hinge * rounding(S, hinge) && (limit.x[0] != S.x[0] || limit.h != S.h);
}

HINGE_COLD PosedSaddles give_up_source(HINGE_IN(PosedSaddles) label, HINGE_IN(HingePoint) bend) {
  PosedSaddles bent;
  bent.sigma = label.sigma + gap(label.source, bend);
  bent.source = bend;
  bent.limit[0] = bend;
  bent.limit[1] = bend;
  return bent;
}

/// From a point on S's side to q beyond the hinge: straight, or bent at the end that it would miss.
HINGE_COLD Real way_beyond(HINGE_IN(HingePoint) from, Real hinge, HINGE_IN(HingePoint) q) {
  HingePose lengths;
  lengths.vertex[0] = Real(0);
  lengths.vertex[1] = lengths.axis2[0] = lengths.inverse[0] = lengths.length2[0] = Real(1);
  HingeCrossing c = crossing(from, q);
  bool misses = c.x[0] < Real(0) || c.x[0] > hinge * c.w;
  HingePoint end = saddle_point(c.x[0] < Real(0) ? Real(0) : hinge, Real(0));
  if (!misses) end = from;
  return gap(from, end) + sqrt(distance_squared(lengths, end, q));
}

/// Length of the path from the source's beginning to q in the triangle beyond the hinge: straight,
/// or bent at a limit it would pass on the wrong side, then at an end of the hinge it would miss.
/// Where an end of the hinge is tighter than the limit, the path bends there at once.
HINGE_COLD Real path_length(HINGE_IN(PosedSaddles) label, Real hinge, HINGE_IN(HingePoint) q) {
  HingePoint S = label.source;
  HingePoint first = saddle_point(Real(0), Real(0)), second = saddle_point(hinge, Real(0));
  bool left =
      left_of(S, label.limit[0], q) > Real(0) && left_of(S, label.limit[0], first) > Real(0);
  bool right =
      left_of(S, label.limit[1], q) < Real(0) && left_of(S, label.limit[1], second) < Real(0);
  if (!left && !right) return label.sigma + way_beyond(S, hinge, q);
  Real way = Real(0);
  if (left) way = gap(S, label.limit[0]) + way_beyond(label.limit[0], hinge, q);
  if (right) way = max(way, gap(S, label.limit[1]) + way_beyond(label.limit[1], hinge, q));
  return label.sigma + way;
}

/// Takes a label over the hinge: gives the source up where the whole hinge is in shadow, then lets
/// the hinge's saddles narrow the limits. The distance is +inf where S lies behind the hinge and no
/// path can bend around the pivot (`last_resort` turns around it nevertheless, so that nothing
/// stays unreached).
HINGE_COLD CrossedHinge cross_hinge(HINGE_IN(PosedSaddles) arriving, HINGE_IN(SaddleHinge) hinge,
                                    bool last_resort) {
  PosedSaddles label = arriving;
  HingePoint first = saddle_point(Real(0), Real(0));
  HingePoint second = saddle_point(hinge.extent, Real(0));
  CrossedHinge crossed;
  bool dropped = false;
  for (int bends = 0; bends < 3; ++bends) {
    HingePoint S = label.source;
    if (S.h < -rounding(S, hinge.extent) && hinge.pivot >= 0) {
      // The strip has turned by more than half a circle around the pivot. (An S in the line of the
      // hinge, at the pivot for one, is not behind it.)
      HingePoint limit = label.limit[1];
      HingePoint pivot = second;
      bool may_bend = hinge.saddle[1];
      if (hinge.pivot == 0) {
        limit = label.limit[0];
        pivot = first;
        may_bend = hinge.saddle[0];
      }
      Real turn = left_of(S, limit, pivot);
      if (bends < 2 && (hinge.pivot == 0 ? turn > Real(0) : turn < Real(0))) {
        label = give_up_source(label, limit);
        continue;
      }
      dropped = !last_resort && !may_bend;
      if (!dropped) label = give_up_source(label, pivot);
      break;
    }
    bool left = hides_hinge(S, label.limit[0], hinge.extent, left_of(S, label.limit[0], second));
    bool right = hides_hinge(S, label.limit[1], hinge.extent, -left_of(S, label.limit[1], first));
    if (!left && !right) break;
    HingePoint limit = label.limit[1];
    if (left) limit = label.limit[0];
    label = give_up_source(label, limit);
  }
  if (hinge.saddle[0] && !(left_of(label.source, label.limit[0], first) > Real(0)))
    label.limit[0] = first;
  if (hinge.saddle[1] && !(left_of(label.source, label.limit[1], second) < Real(0)))
    label.limit[1] = second;
  HingePoint centre =
      saddle_point((hinge.extent + hinge.apex.x[0]) * Real(1. / 3), hinge.apex.h * Real(1. / 3));
  crossed.label = label;
  crossed.distance = dropped ? HINGE_INFINITY : path_length(label, hinge.extent, centre);
  return crossed;
}

/// A label posed on the edge it came in by, turned onto the edge before that (`left`, around the
/// first corner) or the edge after it, as a neighbour that runs the other way sees it. `width` is
/// the length of the edge it came in by, `hinge` that of the other; the angle is between them.
HINGE_COLD PosedSaddles turn_label(HINGE_IN(PosedSaddles) label, bool left, Real width, Real hinge,
                                   Real cosine, Real sine) {
  PosedSaddles turned;
  turned.sigma = label.sigma;
  for (int i = 0; i < 3; ++i) {
    HingePoint p = label.source;
    if (i == 1) p = label.limit[0];
    if (i == 2) p = label.limit[1];
    HINGE_PRECISE Real u = left ? p.x[0] : width - p.x[0];
    HINGE_PRECISE Real along = u * cosine - p.h * sine;
    HINGE_PRECISE Real h = u * sine + p.h * cosine;
    HINGE_PRECISE Real x = left ? along : hinge - along;
    HingePoint q = saddle_point(x, h);
    if (i == 0) turned.source = q;
    if (i == 1) turned.limit[0] = q;
    if (i == 2) turned.limit[1] = q;
  }
  return turned;
}

/// The same label where the neighbour's edge runs the same way: left and right change places.
HINGE_COLD PosedSaddles mirror_label(HINGE_IN(PosedSaddles) label, Real hinge) {
  PosedSaddles mirrored;
  mirrored.sigma = label.sigma;
  mirrored.source = saddle_point(hinge - label.source.x[0], label.source.h);
  mirrored.limit[0] = saddle_point(hinge - label.limit[1].x[0], label.limit[1].h);
  mirrored.limit[1] = saddle_point(hinge - label.limit[0].x[0], label.limit[0].h);
  return mirrored;
}

/// A point posed on the edge before (`left`) or after the one a label came in by, as turn_label's
/// neighbour there would pose it from its own side, posed on the latter.
HINGE_COLD HingePoint turned_back(HINGE_IN(HingePoint) p, bool left, Real width, Real hinge,
                                  Real cosine, Real sine) {
  Real u = left ? hinge - p.x[0] : p.x[0];
  Real along = u * cosine - p.h * sine;
  return saddle_point(left ? along : width - along, -(u * sine + p.h * cosine));
}

/// What `narrow_limits` found.
struct NarrowedLimits {
  HingePoint limit[2];
  bool narrower[2];
};

/// Lateral inheritance: the limits of a label, with those of a neighbour's where they are tighter.
/// A line of sight that never touched a saddle does not know of it, though one beside it does.
/// `other` is the neighbour's label posed on the edge between by turn_label, `apex` that of the
/// label's triangle. Where the two see the same source it is at the same place, within `close`.
///
/// Two limits of a neighbour are of no use here: one that hides the triangle's centre, for then the
/// label came by the saddle's other side, and one that hides the whole edge between.
HINGE_COLD NarrowedLimits narrow_limits(HINGE_IN(PosedSaddles) label, HINGE_IN(PosedSaddles) other,
                                        bool left, Real width, Real hinge, Real cosine, Real sine,
                                        HINGE_IN(HingePoint) apex, Real close) {
  NarrowedLimits found;
  HingePoint S = label.source;
  HingePoint source = turned_back(other.source, left, width, hinge, cosine, sine);
  HingePoint pivot = saddle_point(left ? Real(0) : width, Real(0));
  HingePoint centre = saddle_point((width + apex.x[0]) * Real(1. / 3), apex.h * Real(1. / 3));
  bool lit = !(left_of(S, label.limit[0], centre) > Real(0)) &&
             !(left_of(S, label.limit[1], centre) < Real(0));
  bool same = lit && gap(source, S) <= close;
  for (int i = 0; i < 2; ++i) {
    HingePoint known = i == 0 ? label.limit[0] : label.limit[1];
    HingePoint from = i == 0 ? other.limit[0] : other.limit[1];
    HingePoint limit = turned_back(from, left, width, hinge, cosine, sine);
    // Positive where dark.
    Real side = i == 0 ? Real(1) : Real(-1);
    Real at_pivot = side * left_of(S, limit, pivot), at_apex = side * left_of(S, limit, apex);
    bool hides_edge =
        hides_hinge(S, limit, hinge, at_pivot) && hides_hinge(S, limit, hinge, at_apex);
    bool hides_centre = hides_hinge(S, limit, hinge, side * left_of(S, limit, centre));
    bool is_limit = from.x[0] != other.source.x[0] || from.h != other.source.h;
    bool is_known = known.x[0] != S.x[0] || known.h != S.h;
    Real turn = (limit.h - S.h) * (known.x[0] - S.x[0]) - (limit.x[0] - S.x[0]) * (known.h - S.h);
    found.limit[i] = limit;
    found.narrower[i] =
        same && is_limit && !hides_edge && !hides_centre && (!is_known || side * turn > Real(0));
  }
  return found;
}
