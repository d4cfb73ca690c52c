#pragma once

#include <array>
#include <span>
#include <vector>

#include <plexway/complex/ids.hpp>

namespace plexway {

/// Vertices along a space-filling (Morton) curve. Positions are finite.
std::vector<Index> vertices_along_curve(std::span<const std::array<double, 3>> positions);

/// Vertices by component and, in each, breadth first from the lowest number.
std::vector<Index> vertices_breadth_first(std::size_t vertices,
                                          std::span<const std::array<Index, 2>> edges);

}  // namespace plexway
