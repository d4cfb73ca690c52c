#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include <plexway/common/detail/unfilled.hpp>
#include <plexway/common/ids.hpp>

#include "complexes/solid/tet_corners.hpp"

namespace plexway {

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

}  // namespace plexway
