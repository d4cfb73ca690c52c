#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include <plexway/simplicial/detail/simplex_record.hpp>

namespace plexway {

/// For each facet (N + 1) s + i of simplices with ascending corners: the facet with the same
/// vertices that it is glued to, or none. More than two form a cycle. Cost: n log n at worst.
template <int N>
std::vector<Index> glue_facets(std::size_t vertices,
                               std::span<const std::array<Index, N + 1>> simplices) {
  using Layout = SimplexLayout<N>;
  constexpr std::size_t sides = N + 1;
  const auto vertex = [&](Index facet, std::size_t k) {
    return simplices[facet / sides][Layout::corner(facet % sides, k)];
  };
  // In buckets by their first vertex, then sorted by the others.
  std::vector<Index> begin(vertices + 1, 0), bucket(simplices.size() * sides);
  const Index count = static_cast<Index>(bucket.size());
  for (Index f = 0; f < count; ++f) ++begin[vertex(f, 0) + 1];
  for (std::size_t v = 0; v < vertices; ++v) begin[v + 1] += begin[v];
  {
    std::vector<Index> cursor(begin.begin(), begin.end() - 1);
    for (Index f = 0; f < count; ++f) bucket[cursor[vertex(f, 0)]++] = f;
  }
  const auto same = [&](Index a, Index b) {
    for (std::size_t k = 1; k < N; ++k)
      if (vertex(a, k) != vertex(b, k)) return false;
    return true;
  };
  std::vector<Index> across(bucket.size(), none);
  for (std::size_t v = 0; v < vertices; ++v) {
    const auto first = bucket.begin() + begin[v], last = bucket.begin() + begin[v + 1];
    std::sort(first, last, [&](Index a, Index b) {
      for (std::size_t k = 1; k < N; ++k)
        if (vertex(a, k) != vertex(b, k)) return vertex(a, k) < vertex(b, k);
      return a < b;
    });
    for (auto run = first; run != last;) {
      auto end = run + 1;
      while (end != last && same(*run, *end)) ++end;
      if (end - run > 1)
        for (auto f = run; f != end; ++f) across[*f] = f + 1 == end ? *run : *(f + 1);
      run = end;
    }
  }
  return across;
}

/// Disjoint sets of 0, 1, ..., n - 1.
class DisjointSets {
 public:
  explicit DisjointSets(std::size_t n) : parent_(n) {
    for (std::size_t i = 0; i < n; ++i) parent_[i] = static_cast<Index>(i);
  }
  Index find(Index i) {
    while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
    return i;
  }
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
