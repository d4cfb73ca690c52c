#pragma once

#include <cstddef>
#include <vector>

#include <plexway/common/ids.hpp>

namespace plexway::detail::windows {

/// What waits at a place, a halfedge (4 f + i) or a vertex: a table of the few where anything does,
/// not a number for each of all (24 bytes a vertex, and 4). Of places 64 that follow each other
/// hash side by side. What waits at one place forms a list by `link`, the latest first; Blocks is
/// indexed by their numbers and tells the `place` that each waits at.
class WaitingTable {
 public:
  /// Nothing waits.
  void clear() { heads_.assign(heads_.size(), none); }

  /// Where the list begins that has what waits there. Until the next `make_room`.
  [[nodiscard, gnu::always_inline]] Index& list(Index place) {
    const Index row = (place >> together) * Index{0x9E3779B1} >> shift_;
    return heads_[row ^ (place & ((Index{1} << together) - 1))];
  }

  /// The latest there, or none.
  template <class Blocks>
  [[nodiscard, gnu::always_inline]] static Index find(Index block, Index place,
                                                      const Blocks& blocks) {
    while (block != none && blocks[block].place != place) [[unlikely]] block = blocks[block].link;
    return block;
  }

  template <class Blocks>
  [[gnu::always_inline]] void remove(Index block, Blocks& blocks) {
    Index* at = &list(blocks[block].place);
    while (*at != block) [[unlikely]] at = &blocks[*at].link;
    *at = blocks[block].link;
  }

  /// For so many blocks.
  template <class Blocks>
  void make_room(std::size_t count, Blocks& blocks) {
    while (heads_.size() < sparse * count) {
      std::vector<Index> lists(2 * heads_.size(), none), blocks_of_one;
      lists.swap(heads_);
      --shift_;
      for (Index block : lists) {
        blocks_of_one.clear();
        for (; block != none; block = blocks[block].link) blocks_of_one.push_back(block);
        for (; !blocks_of_one.empty(); blocks_of_one.pop_back()) {  // the latest last
          const Index last = blocks_of_one.back();
          Index& head = list(blocks[last].place);
          blocks[last].link = head;
          head = last;
        }
      }
    }
  }

  /// A block more, and room for it here. What `list` gave is no longer good.
  template <class Block>
  [[nodiscard, gnu::noinline]] Index one_more(std::vector<Block>& blocks) {
    make_room(blocks.size() + 1, blocks);
    if (blocks.size() == blocks.capacity())  // doubled they would be 10 bytes a vertex
      blocks.reserve(blocks.size() + blocks.size() / 4 + 64);
    blocks.emplace_back();
    return static_cast<Index>(blocks.size() - 1);
  }

  [[nodiscard]] std::size_t bytes() const { return heads_.capacity() * sizeof(heads_[0]); }

 private:
  static constexpr int together = 6, least = 10;  // bits
  static constexpr std::size_t sparse = 16;

  std::vector<Index> heads_ = std::vector<Index>(std::size_t{1} << least, none);
  int shift_ = 32 - least;
};

}  // namespace plexway::detail::windows
