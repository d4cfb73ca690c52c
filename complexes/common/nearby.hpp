#pragma once

#include <array>
#include <span>
#include <vector>

#include <plexway/cloud/neighbours.hpp>
#include <plexway/common/ids.hpp>

// The bodies are in distinct_points.cpp.

namespace plexway::detail {

/// Pairs (i, j) with |a[i] - b[j]| <= tolerance: for each point of one list the nearest of the
/// other, the first of several; ascending. Points that are not finite have no pair. Cost: n log n.
std::vector<std::array<Index, 2>> nearby_pairs(std::span<const std::array<double, 3>> a,
                                               std::span<const std::array<double, 3>> b,
                                               double tolerance);

/// May without_near_twins find any? Of points of which no two are at one place; for those that lie
/// beside their neighbours in memory it is much quicker.
[[nodiscard]] bool may_have_near_twins(std::span<const std::array<double, 3>> points,
                                       const Neighbours& neighbours);

}  // namespace plexway::detail
