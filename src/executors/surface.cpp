// The loops: MergedWindows::spread (windows/merged_windows.cpp), ExactWindows::spread
// (windows/exact_windows.cpp), and for `fast` TriangleSpread::share
// (labels/surface/triangle_spread.hpp).

#include "executors/checks.hpp"
#include "executors/curve_sources.hpp"
#include "executors/drive.hpp"
#include "executors/run.hpp"
#include "executors/solve_surface.hpp"
#include "executors/supported.hpp"
#include "executors/threads/window_scheduler.hpp"
#include "windows/window_solver.hpp"

namespace plexway {

template <class E, class Real>
void solve_points(const E& executor, const TriangleMesh<Real>& mesh,
                  std::span<const PointSource> sources, const PropagateOptions& options,
                  Workspace<Real>& kept, DistanceField<Real>& field) {
  WorkspaceState<Real>& workspace = kept.state();
  check(sources, options, mesh);
  const Accuracy accuracy = resolved(
      options.accuracy,
      detail::with(combination<E, TriangleMesh<Real>>(SourceKind::point), mesh.metric(), options));
  const bool by_windows = accuracy.kind() != Accuracy::Kind::fast;
  SuperstepCounts& counts = workspace.pieces.counts();
  counts.start();
  if (by_windows) {
    const auto solved = [&] {
      if constexpr (E::kind == ExecutorKind::openmp)
        return solve_by_windows(executor, mesh, sources, accuracy, options, workspace, field);
      else
        return workspace.windows.on(mesh).solve_by(Alone{}, sources, accuracy, options, workspace,
                                                   field);
    };
    if (solved()) {
      field.accuracy = accuracy;
      counts.tell(field.statistics);
      return;
    }
    field.error.clear();
  }
  with_labels(sources, [&](auto labels) {
    constexpr bool kLabels = decltype(labels)::value;
    drive<kLabels>(executor, mesh, sources, options, workspace,
                   [&](auto queue, const auto& scheduler) {
                     surface::solve_with<Real, kLabels>(mesh, sources, options, workspace, queue,
                                                        scheduler, field);
                   });
  });
  field.statistics.windows_gave_up = by_windows;
  counts.tell(field.statistics);
}

PLEXWAY_SURFACES(PLEXWAY_COMPILE_HERE)

}  // namespace plexway
