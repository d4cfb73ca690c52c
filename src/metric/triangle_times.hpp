#pragma once

#include <plexway/metric/edge_lengths.hpp>

namespace plexway::metric {

/// As triangle_lengths by speeds, of triangles that have lengths and no positions.
[[nodiscard]] std::vector<std::array<double, 3>> triangle_times(
    std::span<const std::array<double, 3>> lengths, std::span<const std::array<Index, 3>> triangles,
    const SimplexSpeeds& metric);

}  // namespace plexway::metric
