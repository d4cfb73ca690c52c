#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include <plexway/common/ids.hpp>

/// Chains of places that strings bend at, from a source on. Each is kept once, as the chain before
/// it and one more place, so that two strings along the same places have the same number.
namespace plexway::detail::strings {

class Chains {
 public:
  /// One link: what comes before it, and the place at its end. Of a root the source.
  struct Link {
    Index parent, place;
  };

  void clear() {
    links_.clear();
    table_.assign(64, none);
  }
  /// The chain with no place.
  Index root(Index source) { return with(none, source); }
  /// The chain with a place behind.
  Index with(Index parent, Index place) {
    if (2 * links_.size() > table_.size()) grow();
    Index& found = table_[slot_of(parent, place)];
    if (found == none) {
      found = static_cast<Index>(links_.size());
      links_.push_back({parent, place});
    }
    return found;
  }

  /// The same, none if there is no such chain.
  [[nodiscard]] Index find(Index parent, Index place) const {
    return table_[slot_of(parent, place)];
  }

  [[nodiscard]] const Link& operator[](Index chain) const { return links_[chain]; }
  [[nodiscard]] bool is_root(Index chain) const { return links_[chain].parent == none; }
  [[nodiscard]] Index source(Index chain) const {
    while (!is_root(chain)) chain = links_[chain].parent;
    return links_[chain].place;
  }

  [[nodiscard]] std::size_t size() const { return links_.size(); }
  [[nodiscard]] std::size_t bytes() const {
    return links_.capacity() * sizeof(Link) + table_.capacity() * sizeof(Index);
  }

 private:
  // Where it is, or is to be.
  [[nodiscard]] std::size_t slot_of(Index parent, Index place) const {
    const std::uint64_t key = std::uint64_t{parent} << 32 | place;
    std::size_t slot = (key * 0x9E3779B97F4A7C15u >> 20) & (table_.size() - 1);
    for (; table_[slot] != none; slot = (slot + 1) & (table_.size() - 1)) {
      const Link& link = links_[table_[slot]];
      if (link.parent == parent && link.place == place) break;
    }
    return slot;
  }
  void grow() {
    table_.assign(2 * table_.size(), none);
    for (Index c = 0; c < links_.size(); ++c)
      table_[slot_of(links_[c].parent, links_[c].place)] = c;
  }

  std::vector<Link> links_;
  std::vector<Index> table_;  // open addressing; a power of two
};

}  // namespace plexway::detail::strings
