#pragma once

#include <array>
#include <span>
#include <vector>

#include <plexway/cloud/neighbours.hpp>
#include <plexway/common/ids.hpp>

namespace plexway {

/// Which points of a cloud are at different places.
struct DistinctPoints {
  /// Of all points at the same place as this one, the lowest number: itself, if there is none.
  std::vector<Index> first;
  /// One point a place (first[i] == i), along a space-filling curve: who is near is soon met.
  std::vector<Index> order;
};

/// Throws InputError naming the point for a coordinate that is not finite, and for more than
/// 2^32 - 2 points. Only coordinates that are equal to the last bit (or 0 and -0) are the same
/// place. Cost: n log n, 0.1 to 0.2 us a point.
[[nodiscard]] DistinctPoints distinct_points(std::span<const std::array<double, 3>> points);

/// The same places, but for points much nearer to each other than to all others, which become one
/// place: where some of a point's neighbours, nearest first, are less than a ten-thousandth as far
/// away as the next, and no more than a third of them. Coordinates that were written and read again
/// differ by that little. Cost: linear.
[[nodiscard]] DistinctPoints without_near_twins(std::span<const std::array<double, 3>> points,
                                                const Neighbours& neighbours,
                                                const DistinctPoints& places);

}  // namespace plexway
