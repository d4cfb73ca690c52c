#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

#include "kernel/lanes.hpp"
#include "windows/entered_triangle.hpp"

namespace plexway::detail::windows {

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

/// A window much narrower than its neighbour takes the neighbour's source, if that is off by no
/// more than `limit` at its ends; so does any where only rounding keeps the two from being the same
/// light. The narrow one says nothing about where the source lies: three distances, two of which
/// are a sliver apart, would move it by what rounding and earlier misses left, and then the light
/// beside it misses vertices that it reaches. `p` and `q` are the widths. False, and nothing done,
/// where that does not fit.
template <class Real>
[[nodiscard, gnu::always_inline]] inline bool absorb(Window<Real>& u, const Window<Real>& w, Real p,
                                                     Real q, Real limit) {
  constexpr Real narrow = Real(1) / 16, roundings = 4;
  const bool by_w = q > p;
  const Window<Real>& wide = by_w ? w : u;
  const Real far = by_w ? wide.at(u.beam.begin) - u.at_begin : wide.at(w.beam.end) - w.at_end;
  const Real near = by_w ? wide.at(u.beam.end) - u.at_end : wide.at(w.beam.begin) - w.at_begin;
  const Real miss = std::max(std::abs(far), std::abs(near));
  const Real share = std::min(p, q) / (p + q);
  const Real rounding = roundings * std::numeric_limits<Real>::epsilon() * std::abs(wide.at_end);
  if (!(miss <= (share < narrow ? limit : rounding)) || wide.beam.is_parallel()) return false;
  const Real mean = share * (far + near) / 2;  // taken off, as below
  u.beam.x = wide.beam.x;
  u.beam.h = wide.beam.h;
  u.beam.end = w.beam.end;
  u.sigma = wide.sigma - mean;
  u.at_begin += (by_w ? far : Real(0)) - mean;
  u.at_end = w.at_end + (by_w ? Real(0) : far) - mean;
  const Real error = std::max(u.error, w.error);
  u.error = std::sqrt(error * error + miss * miss);
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
  if (absorb(u, w, p, q, limit)) return true;
  using L = kernel::Lanes<Real>;
  // Both where they meet, and at their middles.
  const L x_of(u.beam.x, w.beam.x, u.beam.x, w.beam.x), place(b, b, b - p / 2, b + q / 2);
  const L along = place - x_of, off(u.beam.h, w.beam.h, u.beam.h, w.beam.h);
  L before(u.sigma, w.sigma, u.sigma, w.sigma);
  if (u.beam.is_parallel()) [[unlikely]]
    before += place * x_of;
  else
    before += sqrt(along * along + off * off);
  const Real by_u = before[0], by_w = before[1], middle = (by_u + by_w) / 2;
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
  // The middles, and where r is cut the far ends, too.
  // Chosen as a whole: Clang 14 does not come to an end over a vector of two such choices.
  const L counted = bend < least_bend ? L(1) : L(1, 1, 0, 0);
  const L from_foot = L(-p / 2, q / 2, -p, q) - L(x);
  const L after = sqrt(from_foot * from_foot + L(h2)) + L(sigma);
  const L misses = (after - L(before[2], before[3], u.at_begin, w.at_end)) * counted;
  const L size = abs(misses);
  if (kernel::lane_bits(size.v <= L(limit).v) != 15 || !(jump <= limit)) return false;
  const Real miss_u = misses[0], miss_w = misses[1], miss_a = misses[2], miss_c = misses[3];
  const Real miss =
      std::max(std::max(std::max(size[0], size[1]), std::max(size[2], size[3])), jump);
  const Real mean = ((4 * miss_u + miss_a) * p + (4 * miss_w + miss_c) * q) / (6 * (p + q));
  const Real error = std::max(u.error, w.error);
  u.beam.x = b + x;
  u.beam.h = std::sqrt(h2);
  u.beam.end = c;
  u.sigma = sigma - mean;
  u.at_begin += miss_a - mean;
  u.at_end = w.at_end + miss_c - mean;
  u.error = std::sqrt(error * error + miss * miss);
  return true;
}

}  // namespace plexway::detail::windows
