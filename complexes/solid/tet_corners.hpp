#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include <plexway/common/blocks.hpp>
#include <plexway/common/ids.hpp>

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

/// How many vertices to look at at once where each share of them has marks for all: a few shares
/// for each thread, as their tetrahedra take unlike times, and few in all.
inline std::size_t vertex_part(std::size_t vertices, int threads) {
  constexpr std::size_t most = 16, least = 512;
  const auto count = static_cast<std::size_t>(threads_for(threads));
  const std::size_t parts = count == 1 ? 1 : std::min(4 * count, most);
  return std::max(least, (vertices + parts - 1) / parts);
}

}  // namespace plexway
