#include "complex/vertex_order.hpp"

#include "complex/simplex_order.hpp"

namespace plexway {

std::vector<Index> vertices_along_curve(std::span<const std::array<double, 3>> positions) {
  std::vector<std::array<Index, 1>> points(positions.size());
  for (Index v = 0; v < positions.size(); ++v) points[v] = {v};
  return along_curve<1>(positions, points);
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
