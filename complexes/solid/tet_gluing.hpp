#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include <plexway/common/blocks.hpp>
#include <plexway/common/detail/storage.hpp>
#include <plexway/common/ids.hpp>

namespace plexway::detail {

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

/// across[t][i]: 4 u + j if face i of tetrahedron t is face j of u, or none.
using TetGluing = Unfilled<std::array<Index, 4>>;

/// Throws InputError for indices that no solid can have. All of this by any number of threads.
void check_tets(std::size_t vertices, Tets tets, int threads);

/// Tetrahedra that are glued, and what is seen on the way.
struct GluedTets {
  TetGluing across;
  bool fit = true;             ///< do they lie on two sides of each face they share?
  std::size_t edges = 0;       ///< distinct
  std::size_t components = 0;  ///< that share no vertex
};

/// Glues tetrahedra where two share three vertices. Throws InputError naming those of a face that
/// has more than two. Cost: linear as long as few meet at a vertex.
GluedTets glue_tets(Tets tets, const TetCorners& rows, int threads);
/// The same where the corners at each vertex are not known yet.
GluedTets glue_tets(std::size_t vertices, Tets tets, int threads);

/// Which tetrahedra to turn over (their last two corners exchanged) so that all are positive.
/// volume[t]: +2 or -2; +1 or -1 for so little that the rounding of a file may have folded it over;
/// 0 for none. Those without take the side that their neighbours leave them, and so do thin ones
/// that do not fit. Throws InputError where two others lie on the same side of a face.
std::vector<char> orient_tets(Tets tets, const TetGluing& across,
                              std::span<const signed char> volume, int threads);

}  // namespace plexway::detail
