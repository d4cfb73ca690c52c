#include "executors/checks.hpp"
#include "executors/drive.hpp"
#include "executors/owned_crew.hpp"
#include "executors/run.hpp"
#include "executors/solve_solid.hpp"

namespace plexway {

template <class E, class Real>
void solve_points(const E& executor, const TetMesh<Real>& mesh,
                  std::span<const PointSource> sources, const PropagateOptions& options,
                  Workspace<Real>& kept, DistanceField<Real>& field) {
  WorkspaceState<Real>& workspace = kept.state();
  check(sources, options, mesh);
  workspace.pieces.counts().start();
  with_labels(sources, [&](auto labels) {
    constexpr bool kLabels = decltype(labels)::value;
    drive<kLabels>(executor, mesh, sources, options, workspace, [&](auto queue, const auto& crew) {
      solid::solve_with<Real, kLabels>(mesh, sources, options, workspace, queue, crew, field);
    });
  });
  workspace.pieces.counts().tell(field.statistics);
}

PLEXWAY_SOLIDS(PLEXWAY_COMPILE_HERE)

}  // namespace plexway
