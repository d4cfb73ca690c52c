#pragma once

#include <array>
#include <cstddef>
#include <span>

namespace plexway::detail {

/// The axes of a set of points: orthonormal, the direction of least spread first.
struct LocalFrame {
  std::array<double, 3> normal = {0, 0, 1}, u = {1, 0, 0}, v = {0, 1, 0};
  /// Share of the spread along the normal: 0 flat, 1/3 the same in all directions.
  double variation = 0;
};

/// The principal axes of n offsets from a point, the point itself with weight 1 and each offset
/// with its own. With the offsets in one line the normal is any direction across it; without
/// offsets it is the z axis. Offsets are finite.
LocalFrame fit_frame(std::span<const std::array<double, 3>> offsets,
                     std::span<const double> weights);

}  // namespace plexway::detail
