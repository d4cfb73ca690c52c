#include "shape/parts.hpp"

#include <vector>

#include "complexes/common/simplex_gluing.hpp"

namespace plexway {

Parts parts_without(const AnyShape& shape, std::span<const PointSource> points) {
  const std::size_t n = shape.vertices();
  DisjointSets sets(n);
  std::vector<bool> used(n, shape.cloud() != nullptr);
  for (std::size_t s = 0; s < shape.simplices(); ++s) {
    const auto corners = shape.corners(s);
    for (const Index v : corners) {
      used[v] = true;
      sets.unite(v, corners.front());
    }
  }
  if (const CloudShape* cloud = shape.cloud())
    for (Index v = 0; v < cloud->neighbours.point_count(); ++v)
      for (const Index w : cloud->neighbours.around(v)) sets.unite(v, w);
  std::vector<bool> taken(n, false);
  for (const PointSource& point : points)
    taken[sets.find(point.vertex != none ? point.vertex : shape.corners(point.simplex).front())] =
        true;
  Parts left;
  for (Index v = 0; v < n; ++v) {
    const Index root = sets.find(v);
    if (!used[v] || taken[root]) continue;
    ++left.vertices;
    left.count += v == root;
  }
  return left;
}

}  // namespace plexway
