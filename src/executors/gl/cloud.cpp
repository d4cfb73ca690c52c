#include <algorithm>
#include <vector>

#include <plexway/executors/gl.hpp>

#include "executors/cloud_field.hpp"
#include "executors/gl/workspace.hpp"
#include "executors/run.hpp"

namespace plexway {
using namespace detail;

PLEXWAY_ELSEWHERE(GL, TriangleMesh<float>)

void solve_points(const GL& executor, const PointCloud<float>& cloud,
                  std::span<const PointSource> sources, const PropagateOptions& options,
                  GLWorkspace& workspace, DistanceField<float>& field) {
  solve_on_cloud(executor, cloud, sources, options, workspace.implementation().host.moved,
                 workspace, field);
}

bool each_point(const GL& executor, const PointCloud<float>& cloud,
                std::span<const PointSource> sources, const PropagateOptions& options,
                GLWorkspace& workspace, std::span<float> distance) {
  const std::size_t points = cloud.point_count(), vertices = cloud.surface().vertex_count();
  std::vector<PointSource>& moved = workspace.implementation().host.moved;
  moved = first_at_place(cloud, sources, std::move(moved));
  std::vector<float> rows(vertices == points ? 0 : sources.size() * vertices);
  const bool complete = solve_each(executor, cloud.surface(), moved, options, workspace,
                                   rows.empty() ? distance : std::span<float>(rows));
  for (std::size_t k = 0; k < sources.size() && !rows.empty(); ++k)
    std::copy_n(&rows[k * vertices], points, &distance[k * points]);
  for (std::size_t k = 0; k < sources.size(); ++k)
    for (const auto& [twin, first] : cloud.twins())
      distance[k * points + twin] = distance[k * points + first];
  return complete;
}

PLEXWAY_COMPILE(GL, PointCloud<float>)

}  // namespace plexway
