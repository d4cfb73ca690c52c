#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include <plexway/complex/ids.hpp>

namespace plexway {

/// 21 bits spread to every third place.
constexpr std::uint64_t every_third_bit(std::uint64_t q) {
  q = (q | q << 32) & 0x1f00000000ffff;
  q = (q | q << 16) & 0x1f0000ff0000ff;
  q = (q | q << 8) & 0x100f00f00f00f00f;
  q = (q | q << 4) & 0x10c30c30c30c30c3;
  return (q | q << 2) & 0x1249249249249249;
}

/// Simplices (points, if N is 1) along a space-filling (Morton) curve through their centroids.
/// Positions are finite; those of no simplex do not matter. Cost: n log n.
template <std::size_t N>
std::vector<Index> along_curve(std::span<const std::array<double, 3>> positions,
                               std::span<const std::array<Index, N>> simplices) {
  std::array<double, 3> low{}, high{};
  low.fill(std::numeric_limits<double>::infinity());
  high.fill(-std::numeric_limits<double>::infinity());
  for (const auto& simplex : simplices)
    for (const Index v : simplex)
      for (std::size_t d = 0; d < 3; ++d) {
        low[d] = std::min(low[d], positions[v][d]);
        high[d] = std::max(high[d], positions[v][d]);
      }
  // Divided first, and halves: no overflow near 1e308.
  constexpr double cells = 2097151;  // 21 bits
  constexpr double share = N > 1 ? N : 2;
  double width = 0;
  for (std::size_t d = 0; d < 3; ++d) width = std::max(width, high[d] / 2 - low[d] / 2);
  const double scale = width > 0 ? share / N * 0.5 * cells / width : 0;
  struct Keyed {
    std::uint64_t key;
    Index simplex;
  };
  std::vector<Keyed> keyed(simplices.size());
  for (std::size_t s = 0; s < simplices.size(); ++s) {
    std::uint64_t key = 0;
    for (std::size_t d = 0; d < 3; ++d) {
      double centre = 0;
      for (const Index v : simplices[s])
        centre += (positions[v][d] / share - low[d] / share) * scale;
      key |= every_third_bit(static_cast<std::uint64_t>(std::clamp(centre, 0.0, cells))) << d;
    }
    keyed[s] = {key, static_cast<Index>(s)};
  }
  std::sort(keyed.begin(), keyed.end(), [](const Keyed& a, const Keyed& b) {
    return a.key != b.key ? a.key < b.key : a.simplex < b.simplex;
  });
  std::vector<Index> order(simplices.size());
  for (std::size_t i = 0; i < order.size(); ++i) order[i] = keyed[i].simplex;
  return order;
}

/// Simplices by component and, in each, breadth first. across[s][i] is N t + j, side j of the
/// simplex t that side i of s is glued to, or none.
template <std::size_t N>
std::vector<Index> breadth_first(std::span<const std::array<Index, N>> across) {
  std::vector<Index> order;
  order.reserve(across.size());
  std::vector<char> seen(across.size(), 0);
  for (Index seed = 0; seed < across.size(); ++seed) {
    if (seen[seed]) continue;
    seen[seed] = 1;
    std::size_t head = order.size();
    order.push_back(seed);
    while (head < order.size())
      for (const Index side : across[order[head++]]) {
        const Index other = side / static_cast<Index>(N);
        if (side == none || seen[other]) continue;
        seen[other] = 1;
        order.push_back(other);
      }
  }
  return order;
}

}  // namespace plexway
