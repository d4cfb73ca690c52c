// The hinge kernel: one text for C++ (the body of HingeKernel<Real, K>, see hinge.hpp) and GLSL.
//
// A hinge carries a virtual source S from a simplex U to a simplex T over their intersection I, of
// dimension K. Posed on I, every point is (x, h): x its foot in the span of I, h >= 0 its distance
// from that span. Unfolding puts S and the points of T on opposite sides, so the kernel knows K and
// nothing of the dimensions of U and T. Input is squared lengths. Lengths that no flat simplex has
// are clamped to one that exists: finite input never gives NaN.
//
// Two compilers read this, so structs hold plain arrays, results are returned, and loops have fixed
// trip counts with a triangular bound as an `if` inside. Down to `distance_squared` nothing
// branches on a Real, so that there Real may be a SIMD type. What is HINGE_PRECISE no shader compiler
// may rearrange or contract: then llvmpipe gives the bits that C++ gives. A shader that includes
// this text has said `const int K = ...;` and `#define Real float` before.
#ifndef __cplusplus
#define HINGE_CONST const
#define HINGE_FN
#define HINGE_COLD
#define HINGE_IN(type) const type
#define HINGE_PRECISE precise
#define HINGE_INFINITY Real(uintBitsToFloat(0x7f800000u))
#define select(condition, yes, no) ((condition) ? (yes) : (no))
#define HINGE_EPSILON Real(1.1920929e-7)
#define HINGE_TINY Real(8.2718061e-25)
#endif

HINGE_CONST int KX = K > 0 ? K : 1;                // coordinates; no array has length 0
HINGE_CONST int KE = K > 0 ? K * (K + 1) / 2 : 1;  // edges of I: (a < b) is b (b - 1) / 2 + a

/// I in coordinates: vertex 0 is the origin, and the axes are the edges from it made orthogonal
/// one after another but left at their own lengths. That saves every square root and makes x a
/// ratio: for K = 1, x and 1 - x are the barycentric coordinates.
struct HingePose {
  Real vertex[(K + 1) * KX];  // row i is vertex i; from row 1 on, 1 on axis i - 1 and 0 beyond
  Real axis2[KX];             // squared lengths of the axes, 0 where I is degenerate
  Real inverse[KX];           // 1 / axis2, or 0
  Real length2[KX];           // squared lengths of the edges from vertex 0
};
struct HingePoint { Real x[KX]; Real h; };
struct HingeCrossing { Real x[KX]; Real w; };          // the point x / w in the span of I
struct HingeWeights { Real b[K + 1]; };                // barycentric coordinates, times w
struct HingeBend { HingePoint point; Real walked; Real total; };  // b, |S b|, |S b| + |b q|
struct HingeStep { bool visible; Real sigma; HingePoint source; };

/// I posed from its squared edge lengths, in the order (0,1) (0,2) (1,2) (0,3) (1,3) (2,3). For
/// K > 1 a thin I is best given with an end of its shortest edge as vertex 0.
HINGE_FN HingePose make_pose(const Real edge2[KE]) {
  HINGE_PRECISE HingePose hinge;
  for (int j = 0; j < KX; ++j)
    hinge.vertex[j] = hinge.axis2[j] = hinge.inverse[j] = hinge.length2[j] = Real(0);
  for (int i = 1; i <= K; ++i) {
    int first = i * (i - 1) / 2;
    HINGE_PRECISE Real rest = edge2[first];  // of edge (0, i), what the earlier axes do not span
    for (int j = 0; j < K; ++j) {
      hinge.vertex[i * KX + j] = Real(j == i - 1 ? 1 : 0);
      if (j < i - 1) {
        HINGE_PRECISE Real dot = Real(0.5) * (edge2[first] + hinge.length2[j] - edge2[first + j + 1]);
        for (int k = 0; k < K; ++k)
          if (k < j)
            dot -= hinge.axis2[k] * hinge.vertex[(j + 1) * KX + k] * hinge.vertex[i * KX + k];
        hinge.vertex[i * KX + j] = dot * hinge.inverse[j];
        rest -= dot * hinge.vertex[i * KX + j];
      }
    }
    Real noise = max(Real(4) * HINGE_EPSILON * edge2[first], HINGE_TINY);
    Real kept = select(rest > noise, Real(1), Real(0));
    hinge.axis2[i - 1] = kept * rest;
    hinge.inverse[i - 1] = kept / max(rest, noise);
    hinge.length2[i - 1] = edge2[first];
  }
  return hinge;
}

/// a . b in the metric of the axes. (K = 0 has one axis too, of length 0.)
HINGE_FN Real inner(HINGE_IN(HingePose) hinge, const Real a[KX], const Real b[KX]) {
  HINGE_PRECISE Real sum = hinge.axis2[0] * a[0] * b[0];
  for (int j = 1; j < K; ++j) sum += hinge.axis2[j] * a[j] * b[j];
  return sum;
}

/// Squared distance of the feet of two points.
HINGE_FN Real feet_squared(HINGE_IN(HingePose) hinge, HINGE_IN(HingePoint) p,
                           HINGE_IN(HingePoint) r) {
  HINGE_PRECISE Real between[KX];
  for (int j = 0; j < KX; ++j) between[j] = p.x[j] - r.x[j];
  return inner(hinge, between, between);
}

HINGE_FN HingePoint vertex_point(HINGE_IN(HingePose) hinge, int i) {
  HingePoint v;
  for (int j = 0; j < KX; ++j) v.x[j] = hinge.vertex[i * KX + j];
  v.h = Real(0);
  return v;
}

/// The point at squared distances d2 from the vertices of I. On a degenerate axis its x is 0.
HINGE_FN HingePoint locate(HINGE_IN(HingePose) hinge, const Real d2[K + 1]) {
  HINGE_PRECISE HingePoint p = vertex_point(hinge, 0);
  for (int i = 0; i < K; ++i) {
    HINGE_PRECISE Real dot = Real(0.5) * (d2[0] - d2[i + 1] + hinge.length2[i]);
    for (int j = 0; j < K; ++j)
      if (j < i) dot -= hinge.axis2[j] * hinge.vertex[(i + 1) * KX + j] * p.x[j];
    p.x[i] = dot * hinge.inverse[i];
  }
  // h comes from the nearest vertex, which is also the one nearest to the foot: a small height
  // beside a long edge would drown in the rounding of the distance from the far end.
  Real nearest = d2[0];
  Real foot = feet_squared(hinge, p, vertex_point(hinge, 0));
  for (int i = 1; i <= K; ++i) {
    nearest = min(nearest, d2[i]);
    foot = min(foot, feet_squared(hinge, p, vertex_point(hinge, i)));
  }
  p.h = sqrt(max(nearest - foot, Real(0)));
  return p;
}

/// Where the unfolded line from S to q meets the span of I. Homogeneous, because what is asked of
/// it are signs, and those need no division. When both lie in the span it is S's own foot:
/// "visible" then means that S is in I, which never makes a path too short.
HINGE_FN HingeCrossing crossing(HINGE_IN(HingePoint) S, HINGE_IN(HingePoint) q) {
  HINGE_PRECISE HingeCrossing c;
  Real hq = max(q.h, HINGE_TINY);
  for (int j = 0; j < KX; ++j) c.x[j] = S.x[j] * hq + q.x[j] * S.h;
  c.w = S.h + hq;
  return c;
}

HINGE_FN HingeWeights weights(HINGE_IN(HingePose) hinge, HINGE_IN(HingeCrossing) c) {
  HINGE_PRECISE HingeWeights l;
  l.b[0] = c.w;
  for (int n = 0; n < K; ++n) {
    int i = K - n;
    l.b[i] = c.x[i - 1];
    for (int j = 0; j <= K; ++j)
      if (j > i) l.b[i] -= hinge.vertex[j * KX + i - 1] * l.b[j];
    l.b[0] -= l.b[i];
  }
  return l;
}

/// Not negative if the crossing is in I, give or take `tolerance` in each barycentric coordinate.
HINGE_FN Real slack(HINGE_IN(HingePose) hinge, HINGE_IN(HingeCrossing) c, Real tolerance) {
  HingeWeights l = weights(hinge, c);
  Real least = l.b[0];
  for (int i = 1; i <= K; ++i) least = min(least, l.b[i]);
  return least + tolerance * c.w;
}

/// Positive if S, at squared distance d2 from a vertex u of U off I, lies on T's side of I: then no
/// straight line from S passes first U and then I. What rounding can explain is not positive.
HINGE_FN Real behind(HINGE_IN(HingePose) hinge, HINGE_IN(HingePoint) S, HINGE_IN(HingePoint) u,
                     Real d2) {
  HINGE_PRECISE Real level = feet_squared(hinge, S, u) + S.h * S.h + u.h * u.h;
  return d2 - level - Real(8) * HINGE_EPSILON * (d2 + level);
}

/// From the source to a point of T through the span of I.
HINGE_FN Real distance_squared(HINGE_IN(HingePose) hinge, HINGE_IN(HingePoint) S,
                               HINGE_IN(HingePoint) v) {
  HINGE_PRECISE Real sum = feet_squared(hinge, S, v) + (S.h + v.h) * (S.h + v.h);
  return sum;
}

HINGE_FN bool inside(HINGE_IN(HingePose) hinge, HINGE_IN(HingeCrossing) c, Real tolerance) {
  return slack(hinge, c, tolerance) >= Real(0);
}

HINGE_FN HingeBend bend_at(HINGE_IN(HingePose) hinge, HINGE_IN(HingePoint) S,
                           HINGE_IN(HingePoint) q, HINGE_IN(HingePoint) b) {
  HINGE_PRECISE HingeBend bent;
  bent.point = b;
  bent.walked = sqrt(distance_squared(hinge, S, b));
  bent.total = bent.walked + sqrt(distance_squared(hinge, b, q));
  return bent;
}

HINGE_FN HingeBend shorter(HINGE_IN(HingeBend) one, HINGE_IN(HingeBend) other) {
  if (other.total < one.total) return other;
  return one;
}

/// p seen from the edge (a, b): x[0] runs from 0 at a to 1 at b, h is the distance from its line.
HINGE_COLD HingePoint about_edge(HINGE_IN(HingePose) hinge, HINGE_IN(HingePoint) p, int a, int b) {
  HINGE_PRECISE Real edge[KX];
  HINGE_PRECISE Real off[KX];
  HINGE_PRECISE HingePoint seen;
  for (int j = 0; j < KX; ++j) {
    edge[j] = hinge.vertex[b * KX + j] - hinge.vertex[a * KX + j];
    off[j] = p.x[j] - hinge.vertex[a * KX + j];
    seen.x[j] = Real(0);
  }
  seen.x[0] = inner(hinge, edge, off) / max(inner(hinge, edge, edge), HINGE_TINY);
  for (int j = 0; j < KX; ++j) off[j] -= seen.x[0] * edge[j];
  seen.h = sqrt(p.h * p.h + inner(hinge, off, off));
  return seen;
}

/// p seen from the face of I opposite vertex m: x its foot in that face's span, h the distance.
HINGE_COLD HingePoint about_face(HINGE_IN(HingePose) hinge, HINGE_IN(HingePoint) p, int m) {
  HingeCrossing c;
  HINGE_PRECISE HingePoint seen = p;
  HINGE_PRECISE Real normal[KX];
  HINGE_PRECISE Real steep = Real(0);  // squared gradient of barycentric coordinate m, which is 0 on the face
  for (int j = 0; j < KX; ++j) {
    for (int k = 0; k < KX; ++k) c.x[k] = Real(k == j ? 1 : 0);
    c.w = Real(0);
    Real slope = weights(hinge, c).b[m];
    normal[j] = hinge.inverse[j] * slope;
    steep += normal[j] * slope;
  }
  for (int j = 0; j < KX; ++j) c.x[j] = p.x[j];
  c.w = Real(1);
  Real far = weights(hinge, c).b[m] / max(steep, HINGE_TINY);
  for (int j = 0; j < KX; ++j) seen.x[j] -= far * normal[j];
  seen.h = sqrt(p.h * p.h + far * far * steep);
  return seen;
}

/// The point b of the boundary of I over which S reaches q soonest. |S b| + |b q| is convex on each
/// face, so it is least at a vertex or where the line, unfolded about some face, crosses that face.
/// (Projecting the crossing of I onto its boundary is no substitute from K = 2 on.)
HINGE_COLD HingeBend bend(HINGE_IN(HingePose) hinge, HINGE_IN(HingePoint) S,
                          HINGE_IN(HingePoint) q) {
  HingeCrossing c = crossing(S, q);
  // K = 1: the end on the violated side. Only a source behind I needs the better of both.
  if (K == 1 && c.x[0] <= Real(0)) return bend_at(hinge, S, q, vertex_point(hinge, 0));
  if (K == 1 && c.x[0] >= c.w) return bend_at(hinge, S, q, vertex_point(hinge, K));
  HingeBend best = bend_at(hinge, S, q, vertex_point(hinge, 0));
  if (K == 1) best = shorter(best, bend_at(hinge, S, q, vertex_point(hinge, K)));
  for (int i = 0; i < K; ++i)
    for (int j = 1; j <= K; ++j)
      if (K > 1 && i < j) {
        c = crossing(about_edge(hinge, S, i, j), about_edge(hinge, q, i, j));
        Real t = max(Real(0), min(c.x[0] / c.w, Real(1)));
        HINGE_PRECISE HingePoint b = vertex_point(hinge, i);
        for (int k = 0; k < K; ++k) b.x[k] += t * (hinge.vertex[j * KX + k] - b.x[k]);
        best = shorter(best, bend_at(hinge, S, q, b));
      }
  for (int m = 0; m <= K; ++m)
    if (K == 3) {
      c = crossing(about_face(hinge, S, m), about_face(hinge, q, m));
      HingeWeights l = weights(hinge, c);
      bool in_face = true;
      for (int i = 0; i <= K; ++i) in_face = in_face && (i == m || l.b[i] >= Real(0));
      HingePoint b = vertex_point(hinge, 0);
      for (int k = 0; k < K; ++k) b.x[k] = c.x[k] / c.w;
      if (in_face) best = shorter(best, bend_at(hinge, S, q, b));
    }
  return best;
}

/// One step: S, with sigma walked already, aims at q. Visible: both stay. Hidden, or S behind I:
/// the source moves to the bend and sigma grows by the way there. A single vertex (K = 0) always
/// bends. A point v of T is then at most sigma + sqrt(distance_squared(source, v)) away.
HINGE_FN HingeStep carry(HINGE_IN(HingePose) hinge, HINGE_IN(HingePoint) S, Real sigma,
                         HINGE_IN(HingePoint) q, bool is_behind, Real tolerance) {
  HingeStep next;
  next.visible = K > 0 && !is_behind && inside(hinge, crossing(S, q), tolerance);
  next.sigma = sigma;
  next.source = S;
  if (!next.visible) {
    HingeBend bent = bend(hinge, S, q);
    next.sigma = sigma + bent.walked;
    next.source = bent.point;
  }
  return next;
}
