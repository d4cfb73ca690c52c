#include <algorithm>
#include <vector>

#include <plexway/executors/gl.hpp>

#include "executors/cloud_field.hpp"
#include "executors/run.hpp"

namespace plexway {

PLEXWAY_ELSEWHERE(GL, TriangleMesh<float>)

void solve_points(const GL& executor, const PointCloud<float>& cloud,
                  std::span<const PointSource> sources, const PropagateOptions& options,
                  GLWorkspace& workspace, DistanceField<float>& field) {
  solve_on_cloud(cloud, sources, field,
                 [&](const TriangleMesh<float>& surface, std::span<const PointSource> moved) {
                   solve(executor, surface, moved, options, workspace, field);
                 });
}

bool each_point(const GL& executor, const PointCloud<float>& cloud,
                std::span<const PointSource> sources, const PropagateOptions& options,
                GLWorkspace& workspace, std::span<float> distance) {
  const std::size_t points = cloud.point_count(), vertices = cloud.surface().vertex_count();
  bool complete = true;
  solve_on_surface_of(
      cloud, sources, [&](const TriangleMesh<float>& surface, std::span<const PointSource> moved) {
        if (vertices == points) {
          complete = solve_each(executor, surface, moved, options, workspace, distance);
          return;
        }
        std::vector<float> rows(sources.size() * vertices);
        complete = solve_each(executor, surface, moved, options, workspace, std::span<float>(rows));
        for (std::size_t k = 0; k < sources.size(); ++k)
          std::copy_n(&rows[k * vertices], points, &distance[k * points]);
      });
  for (std::size_t k = 0; k < sources.size(); ++k)
    for (const auto& [twin, first] : cloud.twins())
      distance[k * points + twin] = distance[k * points + first];
  return complete;
}

PLEXWAY_COMPILE(GL, PointCloud<float>)

}  // namespace plexway
