#pragma once

#include <span>
#include <string>
#include <utility>
#include <vector>

#include <plexway/cloud/point_cloud.hpp>
#include <plexway/error.hpp>
#include <plexway/solve/distance_field.hpp>
#include <plexway/source/point_source.hpp>
#include <plexway/support.hpp>

namespace plexway::detail {

/// Points of a cloud as vertices of its sheet: each is the first at its place. In the memory of the
/// last argument. Throws UsageError for what is no point of the cloud.
template <class Real>
std::vector<PointSource> first_at_place(const PointCloud<Real>& cloud,
                                        std::span<const PointSource> points,
                                        std::vector<PointSource> first = {}) {
  first.assign(points.begin(), points.end());
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

/// Solves on a cloud, for any executor: the field has the points, twins with one distance. `moved`
/// is room for the sources.
template <class E, class Real, class Workspace>
void solve_on_cloud(const E& executor, const PointCloud<Real>& cloud,
                    std::span<const PointSource> sources, const PropagateOptions& options,
                    std::vector<PointSource>& moved, Workspace& workspace,
                    DistanceField<Real>& field) {
  moved = first_at_place(cloud, sources, std::move(moved));
  solve(executor, cloud.surface(), moved, options, workspace, field);
  field.distance.resize(cloud.point_count());
  if (!field.label.empty()) field.label.resize(cloud.point_count());
  if (!field.error.empty()) field.error.resize(cloud.point_count());
  for (const auto& [twin, first] : cloud.twins()) {
    field.distance[twin] = field.distance[first];
    if (!field.label.empty()) field.label[twin] = field.label[first];
    if (!field.error.empty()) field.error[twin] = field.error[first];
  }
}

}  // namespace plexway::detail
