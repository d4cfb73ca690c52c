#pragma once

#include <array>
#include <functional>
#include <vector>

#include <plexway/cloud/neighbours.hpp>
#include <plexway/common/rows_of.hpp>

namespace plexway {

/// How far the points of a cloud are off a smooth surface, as a share of their spacing: the median
/// over the points. From deviations from the quadrics that fit a point's nearer neighbours, and all
/// of them, best: noise is the same in both, and what grows with the neighbourhood is detail of the
/// surface. It follows the noise up to a quarter of a spacing and reads less beyond it (0.40 for
/// 0.5, 0.47 for 1). Scans of real objects read 0 to 0.05; fewer than 12 neighbours read 0.
///
/// Throws InputError as `smooth`. Cost: 2 us a point for 16 neighbours on one thread.
[[nodiscard]] double noise_level(const GivenPoints& points, const Neighbours& neighbours,
                                 int threads = 0);

/// How much to smooth.
struct SmoothOptions {
  /// Clouds with less noise than this (see noise_level) stay as they are, to the last bit. 0 moves
  /// points of any cloud.
  double least_noise = .06;
  /// How often all points move.
  int rounds = 2;
  int threads = 0;  ///< 0: all there are
  /// Called with the share that is done; returning false stops with Cancelled.
  std::function<bool(double share)> progress = {};
};

/// Where the points would be without noise: each moves, along the normal, onto the quadric that
/// fits its neighbours and theirs best (moving least squares: Levin, Mesh-independent surface
/// interpolation, 2003), all at once, `rounds` times. Along the surface nothing moves, and a curved
/// surface does not shrink: points of a clean sphere move by 12 spacing^4 / radius^3 on average.
/// Edges get rounder, by about a spacing, but only in clouds that are noisy.
///
/// It takes detail away as well, if that is no larger than two or three spacings, and may close
/// thin parts: so it is for clouds whose noise costs more. On distances:
/// docs/contributing/methods/clouds.md.
///
/// Neighbours are those of the points as they came, and may serve afterwards, too; one's own across
/// a gap must not be among them, or the gap closes. Points with fewer than 8 points around stay.
///
/// Throws InputError naming the point for a coordinate that is not finite, and for lists that are
/// no neighbour lists of these points; Cancelled as progress says. The result does not depend on
/// `threads`. Cost: 5 us a point and round for 16 neighbours on one thread.
[[nodiscard]] std::vector<std::array<double, 3>> smooth(const GivenPoints& points,
                                                        const Neighbours& neighbours,
                                                        const SmoothOptions& options = {});

}  // namespace plexway
