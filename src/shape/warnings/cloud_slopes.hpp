#pragma once

#include <array>
#include <span>
#include <vector>

#include <plexway/cloud/neighbours.hpp>

namespace plexway {

/// How values at the points of a cloud grow along its surface, a vector a point: the linear
/// function through the point that is nearest to its neighbours' values, where there are enough of
/// them, else 0. Neighbours whose value is not finite count for nothing. Cost: linear.
[[nodiscard]] std::vector<std::array<double, 3>> cloud_slopes(
    std::span<const std::array<double, 3>> points, std::span<const std::array<double, 3>> normals,
    const Neighbours& neighbours, std::span<const double> value);

}  // namespace plexway
