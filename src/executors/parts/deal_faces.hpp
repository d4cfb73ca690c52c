#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include <plexway/common/ids.hpp>
#include <plexway/executors/piece_ranks.hpp>
#include <plexway/executors/surface_parts.hpp>

#include "executors/parts/vertex_homes.hpp"

namespace plexway {

/// A triangle, in the piece that it went to.
struct DealtFace {
  std::uint64_t key;  ///< its place along the curve
  Index piece, face;
  std::array<Index, 3> corner;
};

/// A surface's triangles in pieces, of which this process has its own.
struct DealtFaces {
  std::vector<DealtFace> faces;  ///< piece by piece, in each along the curve
  std::size_t pieces = 0;        ///< of all processes
};

/// Reads this process's range of faces and deals all to pieces of about `size`: along a curve that
/// is cut by where their middles lie, each to the first of its corners' pieces. All processes call
/// it. Throws InputError naming the face for a
/// vertex out of range or twice in it, no face, or too many.
[[nodiscard]] DealtFaces deal_faces(PieceRanks* ranks, const SurfaceRows& rows,
                                    const VertexHomes& homes, std::size_t size);

}  // namespace plexway
