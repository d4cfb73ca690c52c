#include "complexes/solid/tet_layout.hpp"

#include <utility>

#include <plexway/error.hpp>

#include "complexes/common/building_blocks.hpp"

namespace plexway::detail {

TetLayout::TetLayout(std::size_t vertices, Tets tets, std::vector<Index> order,
                     std::span<const char> turn, int threads)
    : tet(std::move(order)),
      tet_to_inside(tets.size()),
      vertex_to_inside(vertices, none),
      corner(tets.size()) {
  const std::size_t m = tets.size();
  // The caller's may lie anywhere in memory: asked for some tetrahedra ahead.
  constexpr std::size_t ahead = 16;
  over_blocks(m, threads, [&](std::size_t first, std::size_t last) {
    for (std::size_t i = first; i < last; ++i) {
      if (i + ahead < m) __builtin_prefetch(&tets[tet[i + ahead]]);
      const Index t = tet[i];
      tet_to_inside[t] = static_cast<Index>(i) | (turn[t] != 0 ? turned : 0);
      corner[i] = tets[t];
    }
  });
  named = name_vertices(corner, vertex_to_inside, first_use);
  over_blocks(m, threads, [&](std::size_t first, std::size_t last) {
    for (std::size_t i = first; i < last; ++i)
      if (turn[tet[i]] != 0) std::swap(corner[i][2], corner[i][3]);
  });
  rows = corners_of_vertices(vertices, corner, first_use, threads);
}

bool TetLayout::glue(int threads) {
  try {
    glued = glue_tets(corner, rows, threads);
    if (glued.fit) return true;
  } catch (const InputError&) {  // tells of other numbers than the caller's
  }
  glued = {};
  return false;
}

void TetLayout::take_gluing(GluedTets callers, int threads) {
  TetGluing across(tet.size());
  over_blocks(tet.size(), threads, [&](std::size_t first, std::size_t last) {
    for (std::size_t inside = first; inside < last; ++inside)
      for (Index i = 0; i < 4; ++i) {
        const Index t = tet[inside], o = callers.across[t][i];
        across[inside][corner_inside(t, i)] =
            o == none ? none : 4 * (tet_to_inside[o / 4] & ~turned) + corner_inside(o / 4, o % 4);
      }
  });
  glued = std::move(callers);
  glued.across = std::move(across);
}

}  // namespace plexway::detail
