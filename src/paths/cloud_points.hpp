#pragma once

#include <algorithm>
#include <limits>
#include <span>
#include <string>
#include <vector>

#include <plexway/cloud/point_cloud.hpp>
#include <plexway/error.hpp>
#include <plexway/source/point_source.hpp>
#include <plexway/support.hpp>

namespace plexway {

/// Points of a cloud as vertices of its sheet: each is the first at its place. Throws UsageError
/// for what is no point of the cloud.
template <class Real>
std::vector<PointSource> first_at_place(const PointCloud<Real>& cloud,
                                        std::span<const PointSource> points) {
  std::vector<PointSource> first(points.begin(), points.end());
  for (PointSource& p : first) {
    if (p.vertex == none)
      support(combination<Serial, PointCloud<Real>>(SourceKind::point)).require();
    if (p.vertex >= cloud.point_count())
      throw UsageError("point " + std::to_string(p.vertex) + " is out of range, there are " +
                       std::to_string(cloud.point_count()));
    p.vertex = cloud.of_point(p.vertex);
  }
  return first;
}

/// The caller's number of each vertex of a cloud's sheet, by its number inside.
template <class Real>
std::vector<Index> sheet_vertices(const PointCloud<Real>& cloud) {
  std::vector<Index> outer(cloud.surface().vertex_count());
  const std::span<const Index> inside = cloud.surface().vertices_inside();
  for (std::size_t v = 0; v < inside.size(); ++v) outer[inside[v]] = static_cast<Index>(v);
  return outer;
}

/// Distances at all vertices of a cloud's sheet from those of its points; `outer` as above. What
/// joins two points is where both ends are.
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

}  // namespace plexway
