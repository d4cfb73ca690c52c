#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <span>
#include <utility>
#include <vector>

#include <plexway/cloud/neighbours.hpp>

#include "data/cloud_shapes.hpp"

namespace test_clouds {

using plexway::Index;
using Points = std::span<const std::array<double, 3>>;

inline double squared(const std::array<double, 3>& a, const std::array<double, 3>& b) {
  double sum = 0;
  for (std::size_t d = 0; d < 3; ++d) sum += (a[d] - b[d]) * (a[d] - b[d]);
  return sum;
}

/// The k nearest others of each point, by looking at all; the lower number first of equals.
inline plexway::Neighbours by_brute_force(Points points, std::size_t k) {
  plexway::Neighbours result;
  result.begin.push_back(0);
  for (Index i = 0; i < points.size(); ++i) {
    std::vector<std::pair<double, Index>> row;
    for (Index j = 0; j < points.size(); ++j)
      if (j != i) row.push_back({squared(points[i], points[j]), j});
    const std::size_t take = std::min(k, row.size());
    std::partial_sort(row.begin(), row.begin() + static_cast<std::ptrdiff_t>(take), row.end());
    for (std::size_t r = 0; r < take; ++r) result.of.push_back(row[r].second);
    result.begin.push_back(static_cast<Index>(result.of.size()));
  }
  return result;
}

inline plexway::Neighbours near_pairs(Points points, std::size_t k = 16) {
  return plexway::symmetric_closure(by_brute_force(points, k), points);
}

}  // namespace test_clouds
