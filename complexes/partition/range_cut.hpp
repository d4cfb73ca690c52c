#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

#include <plexway/common/ids.hpp>

#include "complexes/partition/cut.hpp"

namespace plexway::detail {

/// A domain whose simplices are numbered from neighbour to neighbour, cut into ranges of these
/// numbers: nothing is numbered anew, nothing copied.
struct RangeCut {
  Cut cut;                             ///< who is whose peer, and no more
  std::size_t count = 0, size = 1;     ///< of simplices, and of them in a piece; the last has fewer
  std::size_t hinges = 0, at_cut = 0;  ///< from a simplex to another, and to one of another piece

  [[nodiscard]] std::size_t piece_of(Index s) const { return s / size; }
  [[nodiscard]] Index begin(std::size_t piece) const { return static_cast<Index>(piece * size); }
  [[nodiscard]] Index end(std::size_t piece) const {
    return static_cast<Index>(std::min(count, (piece + 1) * size));
  }
};

/// neighbours(s, visit) as for `cut`. Ranges of about `size`, rounded up to whole cache lines of
/// labels. Cost: linear.
template <class Neighbours>
[[nodiscard]] RangeCut cut_in_ranges(std::size_t count, std::size_t size,
                                     const Neighbours& neighbours) {
  RangeCut result;
  constexpr std::size_t line = 16;
  result.count = count;
  result.size = (std::max<std::size_t>(size, 1) + line - 1) / line * line;
  const std::size_t pieces = (count + result.size - 1) / result.size;
  result.cut.pieces.resize(pieces);
  std::vector<Index> seen_by(pieces, none);
  for (Index p = 0; p < pieces; ++p) {
    CutPiece& piece = result.cut.pieces[p];
    const Index begin = result.begin(p), end = result.end(p);
    for (Index s = begin; s < end; ++s)
      neighbours(s, [&](Index t) {
        ++result.hinges;
        if (t >= begin && t < end) return;
        ++result.at_cut;
        const std::size_t other = result.piece_of(t);
        if (seen_by[other] == p) return;
        seen_by[other] = p;
        piece.peers.push_back({static_cast<Index>(other), none, 0});
      });
    std::sort(piece.peers.begin(), piece.peers.end(),
              [](const auto& a, const auto& b) { return a.piece < b.piece; });
    piece.own = end - begin;
    piece.peers.push_back({none, none, 0});
  }
  for (Index p = 0; p < pieces; ++p) {
    CutPiece& piece = result.cut.pieces[p];
    for (std::size_t peer = 0; peer < piece.peer_count(); ++peer)
      piece.peers[peer].place =
          static_cast<Index>(result.cut.pieces[piece.peers[peer].piece].place_of(p));
  }
  return result;
}

}  // namespace plexway::detail
