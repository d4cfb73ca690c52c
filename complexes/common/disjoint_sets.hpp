#pragma once

#include <algorithm>
#include <cstddef>
#include <numeric>
#include <vector>

#include <plexway/common/ids.hpp>

namespace plexway {

/// Disjoint sets of 0, 1, ..., n - 1.
class DisjointSets {
 public:
  explicit DisjointSets(std::size_t n) : parent_(n) {
    std::iota(parent_.begin(), parent_.end(), Index{0});
  }
  /// The least of its set.
  Index find(Index i) {
    while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
    return i;
  }
  /// One more, alone.
  void add() { parent_.push_back(static_cast<Index>(parent_.size())); }
  /// Were they apart?
  bool unite(Index i, Index j) {
    if (parent_[i] == parent_[j]) return false;
    i = find(i);
    j = find(j);
    if (i != j) parent_[std::max(i, j)] = std::min(i, j);
    return i != j;
  }

 private:
  std::vector<Index> parent_;
};

}  // namespace plexway
