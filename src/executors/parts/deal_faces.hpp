#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <plexway/common/ids.hpp>
#include <plexway/executors/piece_ranks.hpp>
#include <plexway/executors/surface_parts.hpp>

#include "complexes/partition/deal.hpp"

namespace plexway::detail {

/// Which process has read a vertex: each its range of them. Others ask it for what they need to
/// know of one.
class VertexHomes {
 public:
  /// Reads this process's range. Throws InputError for a coordinate that is not finite.
  VertexHomes(PieceRanks* ranks, const SurfaceRows& rows);

  [[nodiscard]] std::size_t count() const { return count_; }  ///< of vertices
  /// Where the range of a process begins; that of process Deal::count is the end.
  [[nodiscard]] std::size_t begin_of(std::size_t rank) const { return count_ * rank / deal_.count; }
  /// Our own range.
  [[nodiscard]] std::size_t begin() const { return begin_of(deal_.ours); }
  [[nodiscard]] std::size_t size() const { return begin_of(deal_.ours + 1) - begin(); }
  /// Of a vertex of our range.
  [[nodiscard]] const std::array<double, 3>& position(Index vertex) const {
    return positions_[vertex - begin()];
  }
  /// Those of an ascending list that each process has: of rank r from [r] to [r + 1].
  [[nodiscard]] std::vector<std::size_t> ranges_of(std::span<const Index> ascending) const;
  /// Where the vertices of an ascending list lie. All processes call it.
  [[nodiscard]] std::vector<std::array<double, 3>> fetch(std::span<const Index> ascending) const;

 private:
  PieceRanks* ranks_;
  Deal deal_;
  std::size_t count_;
  std::vector<std::array<double, 3>> positions_;
};

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

}  // namespace plexway::detail
