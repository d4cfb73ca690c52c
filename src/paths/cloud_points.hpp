#pragma once

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

}  // namespace plexway
