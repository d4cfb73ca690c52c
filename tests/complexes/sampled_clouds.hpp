#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <span>
#include <utility>
#include <vector>

#include <plexway/cloud/neighbours.hpp>

#include "data/sampled_clouds.hpp"

namespace plexway::testing {

using Position = std::array<double, 3>;
using samples::sampled_cylinder;
using samples::sampled_plane;
using samples::sampled_sphere;
using samples::sampled_swiss;
using samples::SampledCloud;

/// The k nearest of each point, both ways, found by looking at all pairs.
inline Neighbours all_pairs_neighbours(std::span<const Position> points, std::size_t k = 16) {
  Neighbours neighbours;
  neighbours.begin.push_back(0);
  std::vector<std::pair<double, Index>> row;
  for (std::size_t i = 0; i < points.size(); ++i) {
    row.clear();
    for (std::size_t j = 0; j < points.size(); ++j) {
      if (j == i) continue;
      const Position d = samples::operator-(points[j], points[i]);
      row.push_back({samples::dot(d, d), static_cast<Index>(j)});
    }
    const std::size_t kept = std::min(k, row.size());
    std::partial_sort(row.begin(), row.begin() + static_cast<std::ptrdiff_t>(kept), row.end());
    for (std::size_t j = 0; j < kept; ++j) neighbours.of.push_back(row[j].second);
    neighbours.begin.push_back(static_cast<Index>(neighbours.of.size()));
  }
  return symmetric_closure(neighbours, points);
}

}  // namespace plexway::testing
