#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include <plexway/common/detail/storage.hpp>
#include <plexway/common/ids.hpp>
#include <plexway/solid/tet_mesh.hpp>

#include "complexes/solid/tet_gluing.hpp"

namespace plexway::detail {

/// The tetrahedra of a solid as they lie in memory: numbered inside, some turned over, vertices
/// named by their first use, and glued.
struct TetLayout {
  static constexpr Index turned = TetMesh<double>::turned;

  /// `order` lists all tetrahedra, `turn` says which have their last two corners, and so faces,
  /// exchanged. Not glued yet.
  TetLayout(std::size_t vertices, Tets tets, std::vector<Index> order, std::span<const char> turn,
            int threads);

  std::vector<Index> tet;               ///< the caller's, of each inside
  std::vector<Index> tet_to_inside;     ///< and `turned`
  std::vector<Index> vertex_to_inside;  ///< those of no tetrahedron are behind the others
  std::vector<Index> first_use;         ///< vertices named before each block: tell_vertices
  std::size_t named = 0;                ///< vertices of tetrahedra
  Unfilled<std::array<Index, 4>> corner;
  TetCorners rows;  ///< of the vertices inside
  GluedTets glued;

  /// Glued by their corners, which is quick, as neighbours lie beside each other here. False, and
  /// nothing is glued, where glue_tets or orient_tets have something to say or to change.
  [[nodiscard]] bool glue(int threads);
  /// Glued as the caller's tetrahedra are.
  void take_gluing(GluedTets callers, int threads);

  /// Of a tetrahedron of the caller: the corner or face inside.
  [[nodiscard]] Index corner_inside(Index callers_tet, Index i) const {
    return (tet_to_inside[callers_tet] & turned) != 0 && i >= 2 ? 5 - i : i;
  }
};

}  // namespace plexway::detail
