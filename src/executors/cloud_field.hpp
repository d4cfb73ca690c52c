#pragma once

#include <algorithm>
#include <span>
#include <string>
#include <vector>

#include <plexway/cloud/point_cloud.hpp>
#include <plexway/error.hpp>
#include <plexway/solve/distance_field.hpp>
#include <plexway/source/point_source.hpp>

namespace plexway {

/// Calls solve(surface, sources) with the sources of a cloud moved to the first point at their
/// place. Throws UsageError for a number that is not a point's.
template <class Real, class Solve>
void solve_on_surface_of(const PointCloud<Real>& cloud, std::span<const PointSource> sources,
                         Solve solve) {
  for (const PointSource& s : sources) {
    if (s.vertex >= cloud.point_count())
      throw UsageError("source point " + std::to_string(s.vertex) + " is out of range, there are " +
                       std::to_string(cloud.point_count()));
  }
  if (cloud.twins().empty()) {
    solve(cloud.surface(), sources);
    return;
  }
  thread_local std::vector<PointSource> moved;  // so that a second solve allocates nothing
  moved.assign(sources.begin(), sources.end());
  for (PointSource& s : moved) s.vertex = cloud.of_point(s.vertex);
  solve(cloud.surface(), std::span<const PointSource>(moved));
}

/// Solves on a cloud what `solve` solves on its surface, for any executor: the field has the
/// points, twins with one distance.
template <class Real, class Solve>
void solve_on_cloud(const PointCloud<Real>& cloud, std::span<const PointSource> sources,
                    DistanceField<Real>& field, Solve solve) {
  solve_on_surface_of(cloud, sources, solve);
  field.distance.resize(cloud.point_count());
  if (!field.label.empty()) field.label.resize(cloud.point_count());
  if (!field.error.empty()) field.error.resize(cloud.point_count());
  for (const auto& [twin, first] : cloud.twins()) {
    field.distance[twin] = field.distance[first];
    if (!field.label.empty()) field.label[twin] = field.label[first];
    if (!field.error.empty()) field.error[twin] = field.error[first];
  }
}

}  // namespace plexway
