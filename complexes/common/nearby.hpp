#pragma once

#include <array>
#include <span>
#include <vector>

#include <plexway/common/ids.hpp>

namespace plexway {

/// Pairs (i, j) with |a[i] - b[j]| <= tolerance: for each point of one list the nearest of the
/// other, the first of several; ascending. Points that are not finite have no pair. Cost: n log n.
std::vector<std::array<Index, 2>> nearby_pairs(std::span<const std::array<double, 3>> a,
                                               std::span<const std::array<double, 3>> b,
                                               double tolerance);

}  // namespace plexway
