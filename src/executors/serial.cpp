#include <plexway/executors/serial.hpp>

#include "executors/alone.hpp"
#include "executors/checks.hpp"
#include "executors/solve_surface.hpp"

namespace plexway {
namespace {

template <class Real, bool kLabels>
void with_labels(const TriangleMesh<Real>& mesh, std::span<const PointSource> sources,
                 const PropagateOptions& options, Workspace<Real>& workspace,
                 DistanceField<Real>& field) {
  workspace.front.reserve(mesh.face_count());
  with_queue<Real>(options, workspace.front, [&](auto queue) {
    surface::solve_with<Real, kLabels>(mesh, sources, options, workspace, queue, Alone{}, field);
  });
}

}  // namespace

template <class Real>
void propagate(Serial, const TriangleMesh<Real>& mesh, std::span<const PointSource> sources,
               const PropagateOptions& options, Workspace<Real>& workspace,
               DistanceField<Real>& field) {
  check(sources, options, {mesh.vertex_count(), mesh.face_count(), "face", 3});
  if (sources.size() > 1)
    with_labels<Real, true>(mesh, sources, options, workspace, field);
  else
    with_labels<Real, false>(mesh, sources, options, workspace, field);
}

template <class Real>
DistanceField<Real> propagate(Serial executor, const TriangleMesh<Real>& mesh,
                              std::span<const PointSource> sources,
                              const PropagateOptions& options) {
  Workspace<Real> workspace;
  DistanceField<Real> field;
  propagate(executor, mesh, sources, options, workspace, field);
  return field;
}

template void propagate(Serial, const TriangleMesh<float>&, std::span<const PointSource>,
                        const PropagateOptions&, Workspace<float>&, DistanceField<float>&);
template void propagate(Serial, const TriangleMesh<double>&, std::span<const PointSource>,
                        const PropagateOptions&, Workspace<double>&, DistanceField<double>&);
template DistanceField<float> propagate(Serial, const TriangleMesh<float>&,
                                        std::span<const PointSource>, const PropagateOptions&);
template DistanceField<double> propagate(Serial, const TriangleMesh<double>&,
                                         std::span<const PointSource>, const PropagateOptions&);

}  // namespace plexway
