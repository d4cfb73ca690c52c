#pragma once

#include <algorithm>
#include <limits>
#include <span>
#include <vector>

#include <plexway/cloud/point_cloud.hpp>

#include "complexes/common/arrays.hpp"
#include "executors/cloud_field.hpp"

namespace plexway::detail {

/// Distances at all vertices of a cloud's sheet from those of its points; `outer` as
/// vertices_outside has it for that. What joins two points is where both ends are.
template <class Real>
std::vector<Real> sheet_distances(const PointCloud<Real>& cloud, std::span<const Real> points,
                                  std::span<const Index> outer) {
  std::vector<Real> distance(outer.size(), std::numeric_limits<Real>::infinity());
  std::copy(points.begin(), points.end(), distance.begin());
  const auto triangles = cloud.surface().triangles();
  const Real unit = static_cast<Real>(cloud.unit());
  std::vector<Index> corners;
  for (Index v = static_cast<Index>(points.size()); v < distance.size(); ++v) {
    cloud.surface().corners_at(cloud.surface().inside_vertex(v), corners);
    for (const Index c : corners)
      for (const std::size_t e : {std::size_t{c % 3}, edge_before(c % 3)}) {
        const TriangleRecord<Real>& t = triangles[c / 3];
        const Index end = outer[t.corner[e == c % 3 ? edge_after(e) : e]];
        if (end < points.size())
          distance[v] = std::min(distance[v], points[end] + unit * t.length[e]);
      }
  }
  return distance;
}

}  // namespace plexway::detail
