#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <plexway/common/ids.hpp>
#include <plexway/executors/piece_ranks.hpp>

namespace plexway {

/// The place of a cell on Hilbert's curve, 63 bits: cells beside each other on the curve share a
/// face. Each number has 21 bits. Skilling, Programming the Hilbert curve (AIP 2004).
[[nodiscard]] std::uint64_t hilbert_key(std::array<std::uint32_t, 3> cell);

/// A triangle's place along the curve; its number tells those of one cell apart.
struct CurvePlace {
  std::uint64_t key;
  Index face;
};

/// Cuts the curve where it pleases, so that pieces have about as many triangles each, of which each
/// process knows some: by counting those in cells that are made finer where many are. The cut
/// depends on the places alone.
class CurveCells {
 public:
  /// `places`: this process's, of `count` in all. Into `pieces` at most. All processes call it.
  CurveCells(PieceRanks* ranks, std::span<const CurvePlace> places, std::size_t count,
             std::size_t pieces);

  /// So many, none of them empty.
  [[nodiscard]] std::size_t pieces() const { return sizes_.size(); }
  /// Triangles of each.
  [[nodiscard]] std::span<const std::uint64_t> sizes() const { return sizes_; }
  /// `none` in a cell where none of the places is.
  [[nodiscard]] Index piece_of(const CurvePlace& place) const;

 private:
  static constexpr int digit_bits = 4, digits = 24;
  static constexpr std::size_t ways = 1 << digit_bits;
  [[nodiscard]] static std::size_t digit(const CurvePlace& place, int depth);

  struct Node {
    std::uint64_t count;
    Index first;  ///< of its 16 children, or `none`
    Index piece;  ///< where it has none
  };
  std::vector<Node> nodes_;
  std::vector<std::uint64_t> sizes_;
};

}  // namespace plexway
