#include "complexes/solid/tet_corners.hpp"

#include <cstddef>

#include "complexes/common/building_blocks.hpp"

namespace plexway {

TetCorners corners_of_vertices(std::size_t vertices, Tets tets, std::span<const Index> first_use,
                               int threads) {
  TetCorners rows;
  rows.begin.assign(vertices + 1, 0);
  const auto tell_corners = [&](std::size_t first, std::size_t last, const auto& tell) {
    for (std::size_t t = first; t < last; ++t)
      for (std::size_t i = 0; i < 4; ++i) tell(tets[t][i], static_cast<Index>(4 * t + i));
  };
  tell_vertices<Index>(first_use, tets.size(), threads, tell_corners,
                       [&](Index v, Index) { ++rows.begin[v + 1]; });
  for (std::size_t v = 0; v < vertices; ++v) rows.begin[v + 1] += rows.begin[v];
  rows.corner.resize(4 * tets.size());
  std::vector<Index> cursor(rows.begin.begin(), rows.begin.end() - 1);
  tell_vertices<Index>(first_use, tets.size(), threads, tell_corners,
                       [&](Index v, Index c) { rows.corner[cursor[v]++] = c; });
  return rows;
}

}  // namespace plexway
