#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace plexway::io {

/// A wireframe as a file has it.
struct Edges {
  std::vector<std::array<double, 3>> positions;     ///< empty if the file has none
  std::vector<std::array<std::uint32_t, 2>> edges;  ///< 0-based, each < vertices
  std::vector<double> lengths;                      ///< one an edge; empty: from the positions
  std::size_t vertices = 0;
};

}  // namespace plexway::io
