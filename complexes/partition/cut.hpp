#pragma once

#include <algorithm>
#include <cstddef>
#include <span>
#include <utility>
#include <vector>

#include <plexway/common/ids.hpp>

#include "complexes/partition/partition.hpp"

namespace plexway::detail {

/// One piece of a domain: its own simplices, and *ghosts*, those of other pieces beside them. In a
/// piece simplices have numbers of their own: first its own that are ghosts elsewhere, then its
/// others, then its ghosts.
struct CutPiece {
  /// A simplex of this piece, and the number that it has as a ghost of another.
  struct Slot {
    Index here, there;
  };
  /// Another piece that shares hinges with this one.
  struct Peer {
    Index piece;
    Index place;       ///< of this piece among the peers of that one
    Index slot_begin;  ///< what it has as ghosts
  };

  std::vector<Index> simplices;  ///< of each number here, the domain's
  std::size_t at_cut = 0;        ///< so many of its own are ghosts elsewhere
  std::size_t own = 0;           ///< so many are its own
  std::vector<Peer> peers;       ///< in order, and one behind the last that ends its slots
  std::vector<Slot> slots;

  [[nodiscard]] std::size_t peer_count() const { return peers.size() - 1; }
  /// The place of another piece among the peers, which must be one.
  [[nodiscard]] std::size_t place_of(Index other) const {
    const auto found =
        std::lower_bound(peers.begin(), peers.end() - 1, other,
                         [](const Peer& peer, Index number) { return peer.piece < number; });
    return static_cast<std::size_t>(found - peers.begin());
  }
  [[nodiscard]] std::span<const Slot> slots_of(std::size_t peer) const {
    return std::span(slots).subspan(peers[peer].slot_begin,
                                    peers[peer + 1].slot_begin - peers[peer].slot_begin);
  }
  /// The number here of a simplex of the domain that is another piece's; `none` if it is no ghost.
  [[nodiscard]] Index ghost(Index simplex, std::span<const Index> piece_of) const {
    const auto less = [&](Index a, Index b) {
      return std::pair(piece_of[a], a) < std::pair(piece_of[b], b);
    };
    const auto begin = simplices.begin() + static_cast<std::ptrdiff_t>(own);
    const auto found = std::lower_bound(begin, simplices.end(), simplex, less);
    if (found == simplices.end() || *found != simplex) return none;
    return static_cast<Index>(found - simplices.begin());
  }
};

/// All pieces of a partition, and where each simplex went.
struct Cut {
  std::vector<CutPiece> pieces;
  std::vector<Index> piece_of;   ///< of each simplex of the domain
  std::vector<Index> number_of;  ///< and its number there

  [[nodiscard]] std::size_t bytes() const {
    const auto of = [](const auto& v) { return v.capacity() * sizeof(v[0]); };
    std::size_t sum = of(piece_of) + of(number_of) + of(pieces);
    for (const CutPiece& piece : pieces)
      sum += of(piece.simplices) + of(piece.peers) + of(piece.slots);
    return sum;
  }
};

/// neighbours(s, visit) as for `partition`, and symmetric: whoever is visited visits back.
template <class Neighbours>
[[nodiscard]] Cut cut(Partition partition, const Neighbours& neighbours) {
  Cut result;
  result.piece_of = std::move(partition.piece_of);
  result.number_of.resize(result.piece_of.size());
  result.pieces.resize(partition.pieces);
  const std::span<const Index> piece_of = result.piece_of;
  std::vector<std::size_t> sizes(partition.pieces);
  for (const Index p : piece_of) ++sizes[p];
  for (std::size_t p = 0; p < sizes.size(); ++p)
    result.pieces[p].simplices.reserve(sizes[p] * 9 / 8);
  std::vector<bool> inner(piece_of.size());
  for (Index s = 0; s < piece_of.size(); ++s) {
    bool at_cut = false;
    neighbours(s, [&](Index t) { at_cut |= piece_of[t] != piece_of[s]; });
    inner[s] = !at_cut;
    if (at_cut) result.pieces[piece_of[s]].simplices.push_back(s);
  }
  for (CutPiece& piece : result.pieces) piece.at_cut = piece.simplices.size();
  for (Index s = 0; s < piece_of.size(); ++s)
    if (inner[s]) result.pieces[piece_of[s]].simplices.push_back(s);
  for (Index p = 0; p < result.pieces.size(); ++p) {
    CutPiece& piece = result.pieces[p];
    piece.own = piece.simplices.size();
    for (std::size_t i = 0; i < piece.own; ++i)
      result.number_of[piece.simplices[i]] = static_cast<Index>(i);
    for (std::size_t i = 0; i < piece.at_cut; ++i)
      neighbours(piece.simplices[i], [&](Index t) {
        if (piece_of[t] != p) piece.simplices.push_back(t);
      });
    const auto begin = piece.simplices.begin() + static_cast<std::ptrdiff_t>(piece.own);
    std::sort(begin, piece.simplices.end(), [&](Index a, Index b) {
      return std::pair(piece_of[a], a) < std::pair(piece_of[b], b);
    });
    piece.simplices.erase(std::unique(begin, piece.simplices.end()), piece.simplices.end());
    for (std::size_t i = piece.own; i < piece.simplices.size(); ++i)
      if (const Index owner = piece_of[piece.simplices[i]];
          piece.peers.empty() || piece.peers.back().piece != owner)
        piece.peers.push_back({owner, none, 0});
  }
  const auto place_in = [&](Index p, Index peer) {
    const auto& peers = result.pieces[p].peers;
    const auto found =
        std::lower_bound(peers.begin(), peers.end(), peer,
                         [](const CutPiece::Peer& a, Index number) { return a.piece < number; });
    return static_cast<Index>(found - peers.begin());
  };
  // Peer by peer, what it has as ghosts, by its numbers.
  for (Index p = 0; p < result.pieces.size(); ++p) {
    CutPiece& piece = result.pieces[p];
    for (CutPiece::Peer& peer : piece.peers) {
      const CutPiece& other = result.pieces[peer.piece];
      peer.place = place_in(peer.piece, p);
      peer.slot_begin = static_cast<Index>(piece.slots.size());
      const auto first = std::lower_bound(
          other.simplices.begin() + static_cast<std::ptrdiff_t>(other.own), other.simplices.end(),
          p, [&](Index s, Index number) { return piece_of[s] < number; });
      for (auto s = first; s != other.simplices.end() && piece_of[*s] == p; ++s)
        piece.slots.push_back(
            {result.number_of[*s], static_cast<Index>(s - other.simplices.begin())});
    }
  }
  for (CutPiece& piece : result.pieces)
    piece.peers.push_back({none, none, static_cast<Index>(piece.slots.size())});
  return result;
}

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
