#include "executors/parts/curve_cells.hpp"

#include <algorithm>

#include "complexes/common/simplex_order.hpp"
#include "executors/threads/piece_post.hpp"

namespace plexway {

std::uint64_t hilbert_key(std::array<std::uint32_t, 3> x) {
  constexpr std::uint32_t highest = 1u << 20;
  for (std::uint32_t q = highest; q > 1; q >>= 1) {
    const std::uint32_t below = q - 1;
    for (std::uint32_t& one : x) {
      if ((one & q) != 0) {
        x[0] ^= below;
      } else {
        const std::uint32_t both = (x[0] ^ one) & below;
        x[0] ^= both;
        one ^= both;
      }
    }
  }
  x[1] ^= x[0];
  x[2] ^= x[1];
  std::uint32_t turn = 0;
  for (std::uint32_t q = highest; q > 1; q >>= 1)
    if ((x[2] & q) != 0) turn ^= q - 1;
  for (std::uint32_t& one : x) one ^= turn;
  return every_third_bit(x[2]) | every_third_bit(x[1]) << 1 | every_third_bit(x[0]) << 2;
}

std::size_t CurveCells::digit(const CurvePlace& place, int depth) {
  constexpr int in_key = 64 / digit_bits;
  return static_cast<std::size_t>(depth < in_key ? place.key << 1 >> (64 - digit_bits * (depth + 1))
                                                 : std::uint64_t{place.face} >>
                                                       (32 - digit_bits * (depth - in_key + 1))) %
         ways;
}

CurveCells::CurveCells(PieceRanks* ranks, std::span<const CurvePlace> places, std::size_t count,
                       std::size_t pieces)
    : nodes_{{count, none, none}} {
  // Finer than a piece, so that pieces come out even.
  const std::uint64_t most = std::max<std::uint64_t>(count / (16 * pieces), 1);
  std::vector<Index> node(places.size(), 0);  // the finest that holds it
  std::size_t begin = 0;                      // of the last level
  for (int depth = 0; depth < digits; ++depth) {
    const std::size_t end = nodes_.size();
    for (std::size_t n = begin; n < end; ++n)
      if (nodes_[n].count > most && pieces > 1) {
        nodes_[n].first = static_cast<Index>(nodes_.size());
        nodes_.resize(nodes_.size() + ways, {0, none, none});
      }
    if (nodes_.size() == end) break;
    std::vector<std::uint64_t> counts(nodes_.size() - end);
    for (std::size_t i = 0; i < places.size(); ++i) {
      const Index first = nodes_[node[i]].first;
      if (first == none) continue;
      node[i] = static_cast<Index>(first + digit(places[i], depth));
      ++counts[node[i] - end];
    }
    add_up(ranks, counts);
    for (std::size_t k = 0; k < counts.size(); ++k) nodes_[end + k].count = counts[k];
    begin = end;
  }
  // Along the curve: what is not divided goes where its middle falls.
  std::uint64_t before = 0;
  Index last = none;
  std::vector<Index> line = {0};
  while (!line.empty()) {
    Node& n = nodes_[line.back()];
    line.pop_back();
    if (n.first != none) {
      for (std::size_t k = ways; k-- > 0;) line.push_back(static_cast<Index>(n.first + k));
      continue;
    }
    if (n.count == 0) continue;
    const auto wanted = static_cast<Index>((2 * before + n.count) * pieces / (2 * count));
    before += n.count;
    if (wanted != last || sizes_.empty()) sizes_.push_back(0);
    last = wanted;
    sizes_.back() += n.count;
    n.piece = static_cast<Index>(sizes_.size() - 1);
  }
}

Index CurveCells::piece_of(const CurvePlace& place) const {
  const Node* n = &nodes_[0];
  for (int depth = 0; n->first != none; ++depth) n = &nodes_[n->first + digit(place, depth)];
  return n->piece;
}

}  // namespace plexway
