#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <span>
#include <sstream>
#include <vector>

#include <plexway/common/ids.hpp>
#include <plexway/error.hpp>
#include <plexway/simplicial/detail/simplex_record.hpp>

#include "complexes/common/arrays.hpp"

namespace plexway::detail {

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
  std::vector<Index> begin, bucket;
  fill_rows(vertices, begin, bucket, [&](const auto& add) {
    for (Index f = 0; f < simplices.size() * sides; ++f) add(vertex(f, 0), f);
  });
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

template <class Row>
double longest_of(const Row& lengths) {
  return *std::max_element(lengths.begin(), lengths.end());
}

/// Two lengths given for one edge of simplices with edges as long as `longest`: by more than
/// numbers of six digits are rounded. Those below 0 are refused by themselves.
inline bool differ_much(double one, double other, double longest) {
  return one >= 0 && other >= 0 && std::abs(one - other) > 1e-5 * longest;
}

[[noreturn]] inline void refuse_two_lengths(Index a, Index b, double one, double other) {
  std::ostringstream text;
  text << "the edge " << std::min(a, b) << " - " << std::max(a, b) << " has the length " << one
       << " in one simplex and " << other << " in another: give it one";
  throw InputError(text.str());
}

}  // namespace plexway::detail
