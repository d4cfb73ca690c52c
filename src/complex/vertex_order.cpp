#include "complex/vertex_order.hpp"

#include <algorithm>
#include <cstdint>
#include <limits>

namespace plexway {

std::vector<Index> vertices_along_curve(std::span<const std::array<double, 3>> positions) {
  std::array<double, 3> low{}, high{};
  low.fill(std::numeric_limits<double>::infinity());
  high.fill(-std::numeric_limits<double>::infinity());
  for (const auto& p : positions)
    for (std::size_t d = 0; d < 3; ++d) {
      low[d] = std::min(low[d], p[d]);
      high[d] = std::max(high[d], p[d]);
    }
  double width = 0;  // halves: no overflow near 1e308
  for (std::size_t d = 0; d < 3; ++d) width = std::max(width, high[d] / 2 - low[d] / 2);
  constexpr double cells = 2097151;  // 21 bits
  const double scale = width > 0 ? cells / width : 0;
  struct Keyed {
    std::uint64_t key;
    Index vertex;
  };
  std::vector<Keyed> keyed(positions.size());
  for (std::size_t v = 0; v < positions.size(); ++v) {
    std::uint64_t key = 0;
    for (std::size_t d = 0; d < 3; ++d) {
      const double place = (positions[v][d] / 2 - low[d] / 2) * scale;
      std::uint64_t q = static_cast<std::uint64_t>(std::clamp(place, 0.0, cells));
      // Spread 21 bits to every third place.
      q = (q | q << 32) & 0x1f00000000ffff;
      q = (q | q << 16) & 0x1f0000ff0000ff;
      q = (q | q << 8) & 0x100f00f00f00f00f;
      q = (q | q << 4) & 0x10c30c30c30c30c3;
      q = (q | q << 2) & 0x1249249249249249;
      key |= q << d;
    }
    keyed[v] = {key, static_cast<Index>(v)};
  }
  std::sort(keyed.begin(), keyed.end(), [](const Keyed& a, const Keyed& b) {
    return a.key != b.key ? a.key < b.key : a.vertex < b.vertex;
  });
  std::vector<Index> order(positions.size());
  for (std::size_t i = 0; i < order.size(); ++i) order[i] = keyed[i].vertex;
  return order;
}

std::vector<Index> vertices_breadth_first(std::size_t vertices,
                                          std::span<const std::array<Index, 2>> edges) {
  std::vector<Index> begin(vertices + 1, 0);
  for (const auto& ends : edges)
    for (const Index v : ends) ++begin[v + 1];
  for (std::size_t v = 0; v < vertices; ++v) begin[v + 1] += begin[v];
  std::vector<Index> neighbour(2 * edges.size()), at(begin.begin(), begin.end() - 1);
  for (const auto& [a, b] : edges) {
    neighbour[at[a]++] = b;
    neighbour[at[b]++] = a;
  }
  std::vector<char> seen(vertices, 0);
  std::vector<Index> order;
  order.reserve(vertices);
  const auto visit = [&](Index v) {
    if (seen[v] == 0) order.push_back(v);
    seen[v] = 1;
  };
  for (Index start = 0; start < vertices; ++start) {
    const std::size_t first = order.size();
    visit(start);
    for (std::size_t i = first; i < order.size(); ++i)
      for (Index k = begin[order[i]]; k < begin[order[i] + 1]; ++k) visit(neighbour[k]);
  }
  return order;
}

}  // namespace plexway
