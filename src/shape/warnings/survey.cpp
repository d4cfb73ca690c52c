#include "shape/warnings/survey.hpp"

#include <functional>
#include <numeric>
#include <variant>

#include "complexes/common/point3.hpp"
#include "shape/simplex_edges.hpp"

#ifdef PLEXWAY_HAS_BOOST_GRAPH
#include <plexway/boost_graph/graph.hpp>
#endif

namespace plexway {

Bounds bounding_box(std::span<const std::array<double, 3>> positions) {
  Bounds box;
  if (!positions.empty()) box.low = box.high = positions.front();
  for (const auto& position : positions) {
    for (std::size_t k = 0; k < 3; ++k) {
      box.low[k] = std::min(box.low[k], position[k]);
      box.high[k] = std::max(box.high[k], position[k]);
    }
  }
  return box;
}

bool lie_in_line(std::span<const std::array<double, 3>> positions) {
  if (positions.empty()) return false;
  const std::array<double, 3> from = positions.front();
  std::array<double, 3> along{};
  double longest = 0;
  for (const auto& p : positions) {
    const auto off = minus(p, from);
    if (dot(off, off) > longest) longest = dot(off, off), along = off;
  }
  if (!(longest > 0)) return false;
  for (const auto& p : positions) {
    const auto area = cross(along, minus(p, from));
    if (dot(area, area) > 1e-14 * longest * longest) return false;
  }
  return true;
}

Spread spread_of(std::span<const double> lengths) {
  Spread spread;
  for (const double length : lengths) {
    spread.min = std::min(spread.min, length);
    spread.max = std::max(spread.max, length);
  }
  spread.mean =
      std::accumulate(lengths.begin(), lengths.end(), 0.0) / static_cast<double>(lengths.size());
  return spread;
}

#ifdef PLEXWAY_HAS_BOOST_GRAPH
std::optional<std::vector<std::size_t>> component_sizes(const AnyShape& domain) {
  const auto of = [&](const auto& simplices) {
    return boost_graph::connected_components(domain.vertices(), simplices);
  };
  const auto found = std::visit(
      [&](const auto& data) {
        using Data = std::decay_t<decltype(data)>;
        if constexpr (std::is_same_v<Data, io::Triangles>)
          return of(data.triangles);
        else if constexpr (std::is_same_v<Data, io::Tets>)
          return of(data.tets);
        else
          return of(edges_of(domain).edges);
      },
      domain.data());
  std::vector<std::size_t> sizes(found.count, 0);
  for (const Index component : found.of_vertex) ++sizes[component];
  // A vertex in no simplex is a component to Boost, but not to paths.
  std::vector<bool> has_simplices(found.count, false);
  for (std::size_t s = 0; s < domain.simplices(); ++s)
    has_simplices[found.of_vertex[domain.corners(s).front()]] = true;
  std::vector<std::size_t> kept;
  for (std::size_t c = 0; c < found.count; ++c) {
    if (has_simplices[c]) kept.push_back(sizes[c]);
  }
  std::sort(kept.begin(), kept.end(), std::greater<>());
  return kept;
}
#else
std::optional<std::vector<std::size_t>> component_sizes(const AnyShape&) { return std::nullopt; }
#endif

std::string components_warning(std::size_t components) {
  return std::to_string(components) +
         " components: a source reaches only its own, the others get inf";
}

}  // namespace plexway
