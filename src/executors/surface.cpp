// The loops: of `accurate`, the default, MergedWindows::spread (windows/merged_windows.cpp); of
// `exact` ExactWindows::spread (windows/exact_windows.cpp); of `fast` TriangleSpread::share
// (labels/surface/triangle_propagation.hpp).

#include "executors/checks.hpp"
#include "executors/run.hpp"
#include "executors/solve_surface.hpp"
#include "executors/sources.hpp"
#include "executors/threads/piece_scheduler.hpp"
#include "executors/threads/scheduler.hpp"
#include "executors/threads/window_scheduler.hpp"
#include "labels/alone.hpp"
#include "labels/finish.hpp"
#include "labels/front.hpp"
#include "windows/window_solver.hpp"

namespace plexway {
using namespace detail;
namespace {

// What an executor brings to a solve on a surface: a queue for the serial parts, and a scheduler.

/// A queue of its own for each order: the loop is short.
template <bool kLabels, class Real, class Solve>
void drive(const Serial&, const TriangleMesh<Real>& mesh, const PropagateOptions& options,
           WorkspaceState<Real>& workspace, const Solve& solve) {
  workspace.front.reserve(mesh.face_count());
  with_queue<Real>(options, workspace.front, [&](auto queue) { solve(queue, Alone{}); });
}

/// By pieces: a single one is the serial loop.
template <bool kLabels, class Real, class Solve>
void drive(const OpenMP& executor, const TriangleMesh<Real>& mesh, const PropagateOptions& options,
           WorkspaceState<Real>& workspace, const Solve& solve) {
  const Team team(executor);
  const PieceSettings settings = {.size = piece_size(executor, mesh.face_count())};
  if (is_one_piece(settings.size, mesh.face_count())) {
    drive<kLabels>(Serial{}, mesh, options, workspace, solve);
    return;
  }
  workspace.front.reserve(mesh.face_count());
  const DualQueue<Real> queue(workspace.front, std::numeric_limits<Real>::infinity());
  const TeamScheduler<Real> scheduler(team, workspace, step_of<Real>(options), mesh.unit(),
                                      options);
  team.hold([&] { solve(queue, PieceScheduler<Real, kLabels>(scheduler, mesh, settings)); });
}

}  // namespace

template <class E, class Real>
void solve_points(const E& executor, const TriangleMesh<Real>& mesh,
                  std::span<const PointSource> sources, const PropagateOptions& options,
                  Workspace<Real>& kept, DistanceField<Real>& field) {
  WorkspaceState<Real>& workspace = kept.state();
  check(sources, options, mesh);
  const Accuracy accuracy =
      resolved(options.accuracy,
               with(combination<E, TriangleMesh<Real>>(SourceKind::point), mesh.metric(), options));
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
    drive<kLabels>(executor, mesh, options, workspace, [&](auto queue, const auto& scheduler) {
      surface::solve_with<Real, kLabels>(mesh, sources, options, workspace, queue, scheduler,
                                         field);
    });
  });
  field.statistics.windows_gave_up = by_windows;
  counts.tell(field.statistics);
}

PLEXWAY_SURFACES(PLEXWAY_COMPILE_HERE)

}  // namespace plexway
