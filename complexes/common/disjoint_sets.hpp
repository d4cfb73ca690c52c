#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <numeric>
#include <span>
#include <vector>

#include <plexway/common/ids.hpp>

#include "complexes/common/building_blocks.hpp"

namespace plexway::detail {

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

/// How many parts simplices fall into that share no vertex. `lowest`: of each vertex the lowest in
/// its simplices, or none if it has no simplex; used up. Cost: linear, a few instructions a simplex
/// where vertices are numbered by their first use; any number of threads.
template <std::size_t N>
std::size_t count_components(std::span<const std::array<Index, N>> simplices,
                             std::span<Index> lowest, int threads) {
  // Each vertex goes with the lowest that it shares a simplex with, which mostly makes one set of a
  // part; where that leaves several, with all others.
  std::size_t sets = 0;
  for (Index v = 0; v < lowest.size(); ++v) {
    sets += lowest[v] == v;
    if (lowest[v] != none) lowest[v] = lowest[lowest[v]];  // of a lower one, which is known
  }
  if (sets == 1) return 1;
  using Pairs = std::vector<std::array<Index, 2>>;
  DisjointSets joined(lowest.size());
  gather_blocks<Pairs>(
      simplices.size(), threads,
      [&](std::size_t first, std::size_t last, Pairs& differ) {
        for (const auto& corner : simplices.subspan(first, last - first))
          for (std::size_t i = 1; i < N; ++i)
            if (lowest[corner[i]] != lowest[corner[0]])
              differ.push_back({lowest[corner[0]], lowest[corner[i]]});
      },
      [&](const Pairs& differ) {
        for (const auto& [one, other] : differ) sets -= joined.unite(one, other);
      });
  return sets;
}

}  // namespace plexway::detail
