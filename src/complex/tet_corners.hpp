#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include <plexway/complex/detail/unfilled.hpp>
#include <plexway/complex/ids.hpp>

namespace plexway {

/// Tetrahedra by their vertices.
using Tets = std::span<const std::array<Index, 4>>;

/// The tetrahedra at each vertex: corners 4 t + i, row by row, ascending.
struct TetCorners {
  std::vector<Index> begin, corner;

  [[nodiscard]] std::size_t vertices() const { return begin.size() - 1; }
  [[nodiscard]] std::span<const Index> at(Index v) const {
    return std::span(corner).subspan(begin[v], begin[v + 1] - begin[v]);
  }
};
/// `first_use` as in tell_vertices; none given: by one thread.
TetCorners corners_of_vertices(std::size_t vertices, Tets tets, std::span<const Index> first_use,
                               int threads);

}  // namespace plexway
