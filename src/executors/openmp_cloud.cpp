#include <plexway/executors/openmp.hpp>

#include "executors/cloud_field.hpp"

namespace plexway {

template <class Real>
void propagate(const OpenMP& executor, const PointCloud<Real>& cloud,
               std::span<const PointSource> sources, const PropagateOptions& options,
               Workspace<Real>& workspace, DistanceField<Real>& field) {
  solve_on_cloud(cloud, sources, field,
                 [&](const TriangleMesh<Real>& surface, std::span<const PointSource> moved) {
                   propagate(executor, surface, moved, options, workspace, field);
                 });
}

template void propagate(const OpenMP&, const PointCloud<float>&, std::span<const PointSource>,
                        const PropagateOptions&, Workspace<float>&, DistanceField<float>&);
template void propagate(const OpenMP&, const PointCloud<double>&, std::span<const PointSource>,
                        const PropagateOptions&, Workspace<double>&, DistanceField<double>&);

}  // namespace plexway
