#include "complexes/common/nearby.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numeric>

namespace plexway::detail {

namespace {

using Points = std::span<const std::array<double, 3>>;

// For each point of a the nearest of b.
std::vector<std::array<Index, 2>> nearest_pairs(Points a, Points b, double tolerance) {
  // The points of b along one axis, the one in which they spread most; then a band of them each.
  std::array<double, 3> low = {}, high = {};
  for (std::size_t k = 0; k < 3; ++k) {
    const auto [min, max] = std::minmax_element(
        b.begin(), b.end(), [k](const auto& p, const auto& q) { return p[k] < q[k]; });
    if (!b.empty()) low[k] = (*min)[k], high[k] = (*max)[k];
  }
  std::size_t axis = 0;
  for (std::size_t k = 1; k < 3; ++k)
    if (high[k] - low[k] > high[axis] - low[axis]) axis = k;
  std::vector<Index> order(b.size());
  std::iota(order.begin(), order.end(), Index{0});
  std::sort(order.begin(), order.end(), [&](Index i, Index j) {
    return b[i][axis] != b[j][axis] ? b[i][axis] < b[j][axis] : i < j;
  });

  std::vector<std::array<Index, 2>> pairs;
  for (std::size_t i = 0; i < a.size(); ++i) {
    const auto from = std::lower_bound(order.begin(), order.end(), a[i][axis] - tolerance,
                                       [&](Index j, double x) { return b[j][axis] < x; });
    Index best = none;
    double nearest = tolerance;
    for (auto j = from; j != order.end() && b[*j][axis] <= a[i][axis] + tolerance; ++j) {
      const double d = std::hypot(b[*j][0] - a[i][0], b[*j][1] - a[i][1], b[*j][2] - a[i][2]);
      if (d < nearest || (d == nearest && (best == none || *j < best))) nearest = d, best = *j;
    }
    if (best != none) pairs.push_back({static_cast<Index>(i), best});
  }
  return pairs;
}

}  // namespace

std::vector<std::array<Index, 2>> nearby_pairs(Points a, Points b, double tolerance) {
  std::vector<std::array<Index, 2>> pairs = nearest_pairs(a, b, tolerance);
  for (const auto& [j, i] : nearest_pairs(b, a, tolerance)) pairs.push_back({i, j});
  std::sort(pairs.begin(), pairs.end());
  pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
  return pairs;
}

}  // namespace plexway::detail
