#include "complexes/wireframe/vertex_order.hpp"

#include <algorithm>

#include "complexes/common/simplex_order.hpp"

namespace plexway {

std::vector<Index> vertices_along_curve(std::span<const std::array<double, 3>> positions) {
  std::vector<std::array<Index, 1>> points(positions.size());
  for (Index v = 0; v < positions.size(); ++v) points[v] = {v};
  return along_curve<1>(positions, points);
}

std::vector<Index> vertices_in_blocks(std::size_t vertices,
                                      std::span<const std::array<Index, 2>> edges,
                                      std::size_t block) {
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
  // The one visited first that may have neighbours left: the next ones begin there, so that no gaps
  // stay behind.
  std::size_t oldest = 0;
  Index lowest = 0;
  const auto next = [&] {
    for (; oldest < order.size(); ++oldest)
      for (Index k = begin[order[oldest]]; k < begin[order[oldest] + 1]; ++k)
        if (seen[neighbour[k]] == 0) return neighbour[k];
    while (seen[lowest] != 0) ++lowest;
    return lowest;
  };
  while (order.size() < vertices) {
    const std::size_t end = std::min(vertices, order.size() + block);
    while (order.size() < end) {
      std::size_t i = order.size();
      visit(next());
      for (; i < order.size() && order.size() < end; ++i)
        for (Index k = begin[order[i]]; k < begin[order[i] + 1] && order.size() < end; ++k)
          visit(neighbour[k]);
    }
  }
  return order;
}

}  // namespace plexway
