#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include <plexway/common/ids.hpp>

namespace plexway::detail {

/// Vertices along a space-filling (Morton) curve. Positions are finite.
std::vector<Index> vertices_along_curve(std::span<const std::array<double, 3>> positions);

/// Vertices in blocks of so many that lie together: breadth first, but each block begins where the
/// oldest neighbour that is left is, or in the next component at its lowest number.
std::vector<Index> vertices_in_blocks(std::size_t vertices,
                                      std::span<const std::array<Index, 2>> edges,
                                      std::size_t block);

}  // namespace plexway::detail
