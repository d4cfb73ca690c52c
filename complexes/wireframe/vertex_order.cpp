#include "complexes/wireframe/vertex_order.hpp"

#include <algorithm>

#include "complexes/common/fill_rows.hpp"
#include "complexes/common/simplex_order.hpp"

namespace plexway::detail {

std::vector<Index> vertices_along_curve(std::span<const std::array<double, 3>> positions) {
  std::vector<std::array<Index, 1>> points(positions.size());
  for (Index v = 0; v < positions.size(); ++v) points[v] = {v};
  return along_curve<1>(positions, points);
}

std::vector<Index> vertices_in_blocks(std::size_t vertices,
                                      std::span<const std::array<Index, 2>> edges,
                                      std::size_t block) {
  std::vector<Index> begin, neighbour;
  fill_rows(vertices, begin, neighbour, [&](const auto& add) {
    for (const auto& [a, b] : edges) {
      add(a, b);
      add(b, a);
    }
  });
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

}  // namespace plexway::detail
