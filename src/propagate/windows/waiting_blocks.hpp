#pragma once

#include <cstddef>
#include <vector>

#include <plexway/complex/ids.hpp>

namespace plexway::windows {

/// Which block waits at a halfedge: a table of the few that have one, not a place for each of all
/// (24 bytes a vertex). Halfedges hash by triangles, sixteen that follow each other side by side.
/// Blocks of one place form a list by their `link`, the latest first; Blocks is indexed by their
/// numbers and tells the `halfedge`, 4 f + i, that each waits at.
class WaitingBlocks {
 public:
  /// Nothing waits.
  void clear() { heads_.assign(heads_.size(), none); }

  /// Where the list begins that has the blocks of this halfedge. Until the next `make_room`.
  [[nodiscard, gnu::always_inline]] Index& list(Index halfedge) {
    const Index row = (halfedge >> together) * Index{0x9E3779B1} >> shift_;
    return heads_[row ^ (halfedge & ((Index{1} << together) - 1))];
  }

  /// The latest of that halfedge, or none.
  template <class Blocks>
  [[nodiscard, gnu::always_inline]] static Index find(Index block, Index halfedge,
                                                      const Blocks& blocks) {
    while (block != none && blocks[block].halfedge != halfedge)
      [[unlikely]] block = blocks[block].link;
    return block;
  }

  template <class Blocks>
  [[gnu::always_inline]] void remove(Index block, Blocks& blocks) {
    Index* at = &list(blocks[block].halfedge);
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
          Index& head = list(blocks[last].halfedge);
          blocks[last].link = head;
          head = last;
        }
      }
    }
  }

  [[nodiscard]] std::size_t bytes() const { return heads_.capacity() * sizeof(heads_[0]); }

 private:
  static constexpr int together = 6, least = 10;  // bits
  static constexpr std::size_t sparse = 16;

  std::vector<Index> heads_ = std::vector<Index>(std::size_t{1} << least, none);
  int shift_ = 32 - least;
};

}  // namespace plexway::windows
