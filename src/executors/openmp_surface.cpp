#include <plexway/executors/openmp.hpp>

#include "executors/checks.hpp"
#include "executors/crew.hpp"
#include "executors/solve_surface.hpp"
#include "executors/unordered.hpp"

namespace plexway {
namespace {

template <class Real, bool kLabels>
void solve(const Team& team, const TriangleMesh<Real>& mesh, std::span<const PointSource> sources,
           const PropagateOptions& options, Workspace<Real>& workspace,
           DistanceField<Real>& field) {
  workspace.front.reserve(mesh.face_count());
  const DualQueue<Real> queue(workspace.front, std::numeric_limits<Real>::infinity());
  const TeamCrew<Real, kLabels> crew(team, workspace, step_of<Real>(options), mesh.unit(), options);
  surface::solve_with<Real, kLabels>(mesh, sources, options, workspace, queue, crew, field);
}

}  // namespace

template <class Real>
void propagate(const OpenMP& executor, const TriangleMesh<Real>& mesh,
               std::span<const PointSource> sources, const PropagateOptions& options,
               Workspace<Real>& workspace, DistanceField<Real>& field) {
  const Team team(executor);
  check(sources, options, {mesh.vertex_count(), mesh.face_count(), "face", 3});
  check_unordered(sources, options);
  if (sources.size() > 1)
    solve<Real, true>(team, mesh, sources, options, workspace, field);
  else
    solve<Real, false>(team, mesh, sources, options, workspace, field);
}

template void propagate(const OpenMP&, const TriangleMesh<float>&, std::span<const PointSource>,
                        const PropagateOptions&, Workspace<float>&, DistanceField<float>&);
template void propagate(const OpenMP&, const TriangleMesh<double>&, std::span<const PointSource>,
                        const PropagateOptions&, Workspace<double>&, DistanceField<double>&);

}  // namespace plexway
