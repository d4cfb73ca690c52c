
#include <cstddef>
#include <span>

#include "executors/threads/window_scheduler.hpp"
#include "windows/solve_by.inl"

namespace plexway::detail {
template <class Real>
bool solve_by_windows(const OpenMP& executor, const TriangleMesh<Real>& mesh,
                      std::span<const PointSource> sources, Accuracy accuracy,
                      const PropagateOptions& options, WorkspaceState<Real>& workspace,
                      DistanceField<Real>& field) {
  const Team team(executor);
  auto& solver = workspace.windows.on(mesh);
  const std::size_t size = piece_size(executor, mesh.face_count());
  if (is_one_piece(size, mesh.face_count()) || options.schedule != Schedule::dual_queue ||
      solver.kept() != nullptr)
    return solver.solve_by(Alone{}, sources, accuracy, options, workspace, field);
  workspace.front.reserve(mesh.face_count());
  const TeamScheduler<Real> scheduler(team, workspace, 0, mesh.unit(), options);
  bool solved = false;
  team.hold([&] {
    solved = solver.solve_by(WindowScheduler<Real>(scheduler, size), sources, accuracy, options,
                             workspace, field);
  });
  return solved;
}

template bool solve_by_windows(const OpenMP&, const TriangleMesh<float>&,
                               std::span<const PointSource>, Accuracy, const PropagateOptions&,
                               WorkspaceState<float>&, DistanceField<float>&);
template bool solve_by_windows(const OpenMP&, const TriangleMesh<double>&,
                               std::span<const PointSource>, Accuracy, const PropagateOptions&,
                               WorkspaceState<double>&, DistanceField<double>&);

}  // namespace plexway::detail
