#pragma once

#include <algorithm>
#include <cmath>

#include "propagate/windows/entered_triangle.hpp"

namespace plexway::windows {

/// The light of one source on a part of an edge: 32 bytes in float.
template <class Real>
struct Window {
  Beam<Real> beam;
  /// Where windows were merged it may be below 0. Of parallel light the distance at the edge's
  /// first vertex, were it lit.
  Real sigma;
  Real at_begin, at_end;  ///< distances at both ends
  Real error;             ///< what merging may have cost so far, estimated

  [[nodiscard]] Real at(Real b) const {
    if (beam.is_parallel()) [[unlikely]]
      return sigma + b * beam.x;
    const Real u = b - beam.x;
    return sigma + std::sqrt(u * u + beam.h * beam.h);
  }
  /// The nearest distance of all its points.
  [[nodiscard]] Real nearest() const {
    return beam.begin < beam.x && beam.x < beam.end && !beam.is_parallel()
               ? sigma + beam.h
               : std::min(at_begin, at_end);
  }
  [[nodiscard]] Window mirrored(Real length) const {
    return {beam.mirrored(length), beam.is_parallel() ? sigma + length * beam.x : sigma, at_end,
            at_begin, error};
  }
  void begin_at(Real b) { beam.begin = b, at_begin = at(b); }
  void end_at(Real b) { beam.end = b, at_end = at(b); }
};

/// No source of merged windows lies farther away, in mean edges: single precision would lose it.
inline constexpr int farthest_merged = 300;

/// Parallel light that goes on as parallel light: one window in place of the first. False, and
/// nothing done, where the two are not the same light but for rounding, which `limit` is far above.
template <class Real>
[[nodiscard]] bool join_parallel(Window<Real>& u, const Window<Real>& w, Real limit) {
  if (!u.beam.is_parallel() || !w.beam.is_parallel()) return false;
  const Real miss =
      std::max(std::abs(u.at(w.beam.end) - w.at_end), std::abs(w.at(u.beam.begin) - u.at_begin));
  if (!(miss <= limit / 64)) return false;
  if (w.beam.end - w.beam.begin > u.beam.end - u.beam.begin)
    u.beam.x = w.beam.x, u.beam.h = w.beam.h, u.sigma = w.sigma, u.at_begin = u.at(u.beam.begin);
  u.end_at(w.beam.end);
  u.error = std::max(u.error, w.error);
  return true;
}

/// Makes one window of two neighbours, in place of the first: its source gives the same distances
/// at both far ends and where the two meet. False, and nothing done, where they do not fit: where
/// the new one would be off by more than `limit` at one of the places looked at.
///
/// With r the distance of the new source from the point between, those three conditions are linear
/// in r. What then remains in the mean (Simpson's rule) is taken off sigma, so that errors have no
/// sign. A front that is straight or hollow gets the farthest source, and misses the far ends, too.
template <class Real>
[[nodiscard]] inline bool merge(Window<Real>& u, const Window<Real>& w, Real limit) {
  // Where the light of a line and of its end meet, the front goes from straight to round at once:
  // the border is a line that all edges along it share, and what is off there adds up.
  if (u.beam.is_parallel() != w.beam.is_parallel()) return false;
  if (u.beam.is_parallel() && join_parallel(u, w, limit)) return true;
  const Real a = u.beam.begin, b = (u.beam.end + w.beam.begin) / 2, c = w.beam.end;
  const Real p = b - a, q = c - b;
  const Real by_u = u.at(b), by_w = w.at(b), middle = (by_u + by_w) / 2;
  const Real jump = std::abs(by_u - by_w) / 2;
  const Real rise = u.at_begin - middle, fall = w.at_end - middle;
  const Real bend = 2 * (p * fall + q * rise);
  const Real area = p * q * (p + q) - p * fall * fall - q * rise * rise;
  const Real least_bend = area * (Real(1) / farthest_merged);
  const Real r = area / std::max(bend, least_bend);
  const Real x = ((2 * r + rise) * rise - p * p - (2 * r + fall) * fall + q * q) / (2 * (p + q));
  const Real h2 = r * r - x * x;
  if (!(area > 0) || !(h2 > 0)) return false;
  const Real sigma = middle - r;
  const auto at = [&](Real from_b) {
    const Real along = from_b - x;
    return sigma + std::sqrt(along * along + h2);
  };
  const Real miss_u = at(-p / 2) - u.at(b - p / 2), miss_w = at(q / 2) - w.at(b + q / 2);
  // Where r is cut the far ends, too.
  const Real cut = bend < least_bend ? Real(1) : Real(0);
  const Real miss_a = cut * (at(-p) - u.at_begin), miss_c = cut * (at(q) - w.at_end);
  const Real miss_inside = std::max(std::max(std::abs(miss_u), std::abs(miss_w)), jump);
  const Real miss = std::max(miss_inside, std::max(std::abs(miss_a), std::abs(miss_c)));
  if (!(miss <= limit)) return false;
  const Real mean = ((4 * miss_u + miss_a) * p + (4 * miss_w + miss_c) * q) / (6 * (p + q));
  const Real before = std::max(u.error, w.error);
  u.beam.x = b + x;
  u.beam.h = std::sqrt(h2);
  u.beam.end = c;
  u.sigma = sigma - mean;
  u.at_begin += miss_a - mean;
  u.at_end = w.at_end + miss_c - mean;
  u.error = std::sqrt(before * before + miss * miss);
  return true;
}

}  // namespace plexway::windows
