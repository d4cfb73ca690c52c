#pragma once

// For programs that hold a `pcl::PointCloud<PointT>` themselves. Everything here is a template that
// uses `points` and `x y z` alone, so no header of PCL is needed.

#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <string>
#include <vector>

#include <plexway/common/ids.hpp>
#include <plexway/error.hpp>

namespace plexway::pcl {

/// The points of a cloud that are finite, as in a dense cloud all are.
struct FinitePoints {
  /// In the cloud's unit and order.
  std::vector<std::array<double, 3>> positions;
  std::vector<Index> place;  ///< where each of them is in the cloud, ascending
};

/// The finite points of a `pcl::PointCloud<PointT>`, of any PointT with `x y z`, organised or not.
/// Throws InputError where there is none, and where there are more than Index counts.
template <class Cloud>
FinitePoints finite_points(const Cloud& cloud) {
  if (cloud.points.size() >= none) throw InputError("the cloud has more points than 32 bits count");
  FinitePoints found;
  found.positions.reserve(cloud.points.size());
  found.place.reserve(cloud.points.size());
  for (std::size_t i = 0; i < cloud.points.size(); ++i) {
    const auto& point = cloud.points[i];
    const std::array<double, 3> at = {static_cast<double>(point.x), static_cast<double>(point.y),
                                      static_cast<double>(point.z)};
    if (!std::isfinite(at[0]) || !std::isfinite(at[1]) || !std::isfinite(at[2])) continue;
    found.positions.push_back(at);
    found.place.push_back(static_cast<Index>(i));
  }
  if (found.positions.empty()) throw InputError("the cloud has no finite point");
  return found;
}

/// The distances of the finite points (`distance`, one for each of `from.place`) as the `intensity`
/// of `cloud`, such as a `pcl::PointCloud<pcl::PointXYZI>` of the same size as the one that `from`
/// came from. Points that are not finite get +inf: no path leads there. Throws UsageError for
/// lengths that do not fit.
template <class Cloud, class Distances>
void set_intensity(Cloud& cloud, const FinitePoints& from, const Distances& distance) {
  if (std::size(distance) != from.place.size())
    throw UsageError("set_intensity: " + std::to_string(std::size(distance)) + " distances for " +
                     std::to_string(from.place.size()) + " finite points");
  if (!from.place.empty() && from.place.back() >= cloud.points.size())
    throw UsageError("set_intensity: the cloud has " + std::to_string(cloud.points.size()) +
                     " points, but the distances are of a larger one");
  for (auto& point : cloud.points)
    point.intensity = std::numeric_limits<decltype(point.intensity)>::infinity();
  for (std::size_t i = 0; i < from.place.size(); ++i) {
    auto& intensity = cloud.points[from.place[i]].intensity;
    intensity = static_cast<std::decay_t<decltype(intensity)>>(distance[i]);
  }
}

}  // namespace plexway::pcl
