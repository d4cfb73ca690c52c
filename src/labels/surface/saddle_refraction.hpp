#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

#include "labels/surface/saddle_step.hpp"

/// One update under Visibility::saddles over an edge that the triangles on both sides measure
/// differently: where a speed or a tensor jumps (SurfaceHints::refracts).
///
/// Each triangle is flat in its own lengths, and the two parametrise the edge alike. Fermat: a path
/// from S to q crosses where |S s| + |s q| is least, and this is Snell's law for any two tensors.
/// The light of a point is then no longer that of a point. But along one ray it is to second order
/// that of a point S' on the ray behind the crossing: curvatures of the front must agree along the
/// edge,
///
///     cos^2(out) / |S' s| = cos^2(in) / (scale^2 |S s|).
///
/// So each triangle beyond gets an S' of its own, and the ends of the edge as limits: outside this
/// beam the path bends there, which is a path.
namespace plexway::detail {

/// Where the path from S to q crosses an edge, measured on S's side: least |S s| + |scale s - q|.
/// The sum is convex. Newton's steps, halving where they leave the bracket.
template <class Real>
Real fermat_crossing(const typename PosedSaddles<Real>::Point& S,
                     const typename PosedSaddles<Real>::Point& q, Real width, Real scale) {
  const Real x = S.x[0], h = std::max(S.h, Real(0));
  // `side` decides at S itself, where S lies on the edge.
  const auto slope = [&](Real s, Real side, Real& curve) {
    const Real a = s - x, b = scale * s - q.x[0];
    const Real before = std::sqrt(a * a + h * h), after = std::sqrt(b * b + q.h * q.h);
    curve = 0;
    if (before > 0) curve += (h / before) * (h / before) / before;
    if (after > 0) curve += scale * scale * (q.h / after) * (q.h / after) / after;
    return (before > 0 ? a / before : side) + (after > 0 ? scale * b / after : Real(0));
  };
  Real low = 0, high = width, curve = 0;
  if (slope(low, Real(1), curve) >= 0) return low;
  if (slope(high, Real(-1), curve) <= 0) return high;
  if (h == 0 && x > 0 && x < width) {  // a kink at S: the path may start right there
    if (slope(x, Real(-1), curve) > 0)
      high = x;
    else if (slope(x, Real(1), curve) < 0)
      low = x;
    else
      return x;
  }
  Real s = (low + high) / 2;
  for (int i = 0; i < 40; ++i) {
    const Real up = slope(s, Real(0), curve);
    (up < 0 ? low : high) = s;
    Real next = curve > 0 ? s - up / curve : low;
    if (!(next > low && next < high)) next = (low + high) / 2;
    const Real moved = std::abs(next - s);
    s = next;
    if (moved <= 4 * std::numeric_limits<Real>::epsilon() * width) break;
  }
  return s;
}

/// Takes a label, posed on the edge in the lengths of the triangle before, over it; `width` is the
/// edge's length there. Returns the distance of the centre beyond, never infinite.
template <class Real>
Real refract(PosedSaddles<Real>& label, const SaddleHinge<Real>& hinge, Real width) {
  using Point = typename PosedSaddles<Real>::Point;
  using Kernel = kernel::SaddleKernel<Real>;
  const Real scale = hinge.extent / width;
  const Point first = {{Real(0)}, Real(0)}, second = {{width}, Real(0)};
  const Point centre = {{(hinge.extent + hinge.apex.x[0]) / 3}, hinge.apex.h / 3};
  const auto is_limit = [&](const Point& p) {
    return p.x[0] != label.source.x[0] || p.h != label.source.h;
  };
  const auto beyond = [&](Real s) { return std::hypot(centre.x[0] - scale * s, centre.h); };

  Real low = 0, high = width, s = 0;
  for (int bends = 0;; ++bends) {
    if (label.source.h < -Kernel::rounding(label.source, width) && hinge.pivot >= 0) {
      // The strip has turned by more than half a circle: around the pivot, by the limit there.
      const Point pivot = hinge.pivot == 0 ? first : second;
      const Point limit = label.limit[hinge.pivot];
      const Real turn = Kernel::left_of(label.source, limit, pivot);
      if (is_limit(limit) && (hinge.pivot == 0 ? turn > 0 : turn < 0))
        give_up_source<Real>(label, limit);
      give_up_source<Real>(label, pivot);
    }
    label.source.h = std::max(label.source.h, Real(0));
    // The lit part of the edge.
    const Point S = label.source;
    low = 0;
    high = width;
    int dark = -1;
    for (int i = 0; i < 2; ++i) {
      const Point limit = label.limit[i];
      if (!is_limit(limit)) continue;
      const Real side = i == 0 ? Real(1) : Real(-1);
      const bool near = side * Kernel::left_of(S, limit, i == 0 ? first : second) > 0;
      const bool far = side * Kernel::left_of(S, limit, i == 0 ? second : first) > 0;
      if (far) dark = i;
      if (!near || far) continue;
      const Real drop = S.h - limit.h;
      const Real at = drop > 0 ? S.x[0] + (limit.x[0] - S.x[0]) * (S.h / drop) : S.x[0];
      if (i == 0)
        low = std::clamp(at, low, width);
      else
        high = std::clamp(at, Real(0), high);
    }
    s = fermat_crossing<Real>(S, centre, width, scale);
    if (dark < 0 && s < low && is_limit(label.limit[0])) dark = 0;
    if (dark < 0 && s > high && is_limit(label.limit[1])) dark = 1;
    if (dark < 0 || bends == 2) break;
    give_up_source<Real>(label, Point(label.limit[dark]));
  }

  const Point S = label.source;
  const Real before = std::hypot(S.x[0] - s, S.h), after = beyond(s);
  const Real distance = label.sigma + before + after;
  if (s <= 0 || s >= width) {  // bends at an end
    label.sigma += before;
    label.source = label.limit[0] = label.limit[1] = {{s <= 0 ? Real(0) : hinge.extent}, Real(0)};
    return distance;
  }
  // The beam: what is lit, what is not farther along the edge than S, and what enters: beyond the
  // critical angle paths run along the edge.
  const Real reach = before / 2;
  if (scale < 1) {
    const Real critical = S.h * scale / std::sqrt(1 - scale * scale);
    low = std::max(low, S.x[0] - critical);
    high = std::min(high, S.x[0] + critical);
  }
  low = std::min(std::max(low, s - reach), s);
  high = std::max(std::min(high, s + reach), s);

  // Where light enters along the edge, fronts beyond are straight: S' is far away, but no farther
  // than rounding allows. And so near that no point of the beam is nearer to S' than to S, for
  // then nothing ever comes out shorter than a path.
  const Real ux = after > 0 ? (centre.x[0] - scale * s) / after : Real(0);
  const Real out = after > 0 ? centre.h / after : Real(1);
  const Real in2 = before > 0 ? (S.h / before) * (S.h / before) : Real(1);
  const Real farthest = hinge.extent * (sizeof(Real) == 4 ? Real(300) : Real(1e5));
  const Real wanted = scale * scale * out * out * before;
  Real radius = wanted < in2 * farthest ? wanted / in2 : farthest;
  const Real rounding = Kernel::rounding(S, width);
  for (const Real end : {low, high}) {
    const Real along = scale * (end - s);
    const Real longer = std::hypot(S.x[0] - end, S.h) - before;
    const Real bow = longer - along * ux;
    if (bow > rounding)
      radius = std::min(radius, std::max((along * along - longer * longer) / (2 * bow), Real(0)));
  }
  label.sigma += before - radius;
  label.source = {{scale * s - radius * ux}, radius * out};
  label.limit[0] = {{scale * low}, Real(0)};
  label.limit[1] = {{scale * high}, Real(0)};
  return distance;
}

}  // namespace plexway::detail
