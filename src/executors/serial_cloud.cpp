#include <plexway/executors/serial_cloud.hpp>

#include "executors/cloud_field.hpp"

namespace plexway {

template <class Real>
void propagate(Serial executor, const PointCloud<Real>& cloud, std::span<const PointSource> sources,
               const PropagateOptions& options, Workspace<Real>& workspace,
               DistanceField<Real>& field) {
  solve_on_cloud(cloud, sources, field,
                 [&](const TriangleMesh<Real>& surface, std::span<const PointSource> moved) {
                   propagate(executor, surface, moved, options, workspace, field);
                 });
}

template <class Real>
DistanceField<Real> propagate(Serial executor, const PointCloud<Real>& cloud,
                              std::span<const PointSource> sources,
                              const PropagateOptions& options) {
  Workspace<Real> workspace;
  DistanceField<Real> field;
  propagate(executor, cloud, sources, options, workspace, field);
  return field;
}

template void propagate(Serial, const PointCloud<float>&, std::span<const PointSource>,
                        const PropagateOptions&, Workspace<float>&, DistanceField<float>&);
template void propagate(Serial, const PointCloud<double>&, std::span<const PointSource>,
                        const PropagateOptions&, Workspace<double>&, DistanceField<double>&);
template DistanceField<float> propagate(Serial, const PointCloud<float>&,
                                        std::span<const PointSource>, const PropagateOptions&);
template DistanceField<double> propagate(Serial, const PointCloud<double>&,
                                         std::span<const PointSource>, const PropagateOptions&);

}  // namespace plexway
