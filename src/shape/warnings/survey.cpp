#include "shape/warnings/survey.hpp"

#include <algorithm>
#include <functional>
#include <numeric>

#include "complexes/common/geometry.hpp"
#include "shape/shape_state.hpp"

namespace plexway::detail {

Box<3> bounding_box(std::span<const std::array<double, 3>> positions) {
  if (positions.empty()) return {};
  auto box = Box<3>::empty();
  for (const auto& position : positions) box.add(position);
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

std::size_t count_coincident(const AnyShape& shape) {
  const auto at = shape.positions();
  if (at.empty() || shape.kind() == DomainKind::simplices || shape.kind() == DomainKind::mixed)
    return 0;
  std::vector<bool> used(at.size(), false);
  for (const io::Cells& cells : shape.state().cells)
    for (const Index v : cells.connectivity) used[v] = true;
  std::vector<Index> order;
  for (Index v = 0; v < used.size(); ++v)
    if (used[v]) order.push_back(v);
  std::sort(order.begin(), order.end(), [&](Index a, Index b) { return at[a] < at[b]; });
  std::size_t coincident = 0;
  for (std::size_t i = 0; i < order.size(); ++i) {
    const bool as_before = i > 0 && at[order[i - 1]] == at[order[i]];
    const bool as_after = i + 1 < order.size() && at[order[i + 1]] == at[order[i]];
    if (as_before || as_after) ++coincident;
  }
  return coincident;
}

DisjointSets joined_vertices(const AnyShape& shape) {
  DisjointSets sets(shape.vertices());
  for (const io::Cells& cells : shape.state().cells)
    for (std::size_t i = 0; i < cells.connectivity.size(); ++i)
      sets.unite(cells.connectivity[i], cells.connectivity[i - i % cells.corners]);
  if (const CloudShape* const cloud = shape.cloud())
    for (Index v = 0; v < cloud->neighbours.point_count(); ++v)
      for (const Index w : cloud->neighbours.around(v)) sets.unite(v, w);
  return sets;
}

std::vector<std::size_t> component_sizes(const AnyShape& shape) {
  DisjointSets sets = joined_vertices(shape);
  std::vector<std::size_t> size(shape.vertices(), 0);
  for (Index v = 0; v < size.size(); ++v) ++size[sets.find(v)];
  // A vertex in no simplex is no component.
  std::vector<bool> used(size.size(), false);
  for (const io::Cells& cells : shape.state().cells)
    for (const Index v : cells.connectivity) used[sets.find(v)] = true;
  std::vector<std::size_t> found;
  for (Index v = 0; v < size.size(); ++v)
    if (used[v]) found.push_back(size[v]);
  std::sort(found.begin(), found.end(), std::greater<>());
  return found;
}

std::string components_warning(std::size_t components) {
  return std::to_string(components) +
         " components: a source reaches only its own, the others get inf";
}

}  // namespace plexway::detail
