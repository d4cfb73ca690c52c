#include <plexway/executors/gl.hpp>

#include "executors/cloud_field.hpp"

namespace plexway {

void propagate(GL executor, const PointCloud<float>& cloud, std::span<const PointSource> sources,
               const PropagateOptions& options, GLWorkspace& workspace,
               DistanceField<float>& field) {
  solve_on_cloud(cloud, sources, field,
                 [&](const TriangleMesh<float>& surface, std::span<const PointSource> moved) {
                   propagate(executor, surface, moved, options, workspace, field);
                 });
}

}  // namespace plexway
