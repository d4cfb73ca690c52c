#pragma once

#include <cstddef>
#include <limits>
#include <span>
#include <type_traits>

#include <plexway/executors.hpp>
#include <plexway/surface/triangle_mesh.hpp>

#include "executors/threads/piece_scheduler.hpp"
#include "executors/threads/scheduler.hpp"
#include "labels/alone.hpp"
#include "labels/finish.hpp"
#include "labels/front.hpp"

/// What an executor brings to a solve on a surface: a queue for the serial parts, and a scheduler.
namespace plexway {

/// A queue of its own for each order: the loop is short.
template <bool kLabels, class Real, class Solve>
void drive(const Serial&, const TriangleMesh<Real>& mesh, std::span<const PointSource>,
           const PropagateOptions& options, WorkspaceState<Real>& workspace, const Solve& solve) {
  workspace.front.reserve(mesh.face_count());
  with_queue<Real>(options, workspace.front, [&](auto queue) { solve(queue, Alone{}); });
}

/// By pieces: a single one is the serial loop.
template <bool kLabels, class Real, class Solve>
void drive(const OpenMP& executor, const TriangleMesh<Real>& mesh,
           std::span<const PointSource> sources, const PropagateOptions& options,
           WorkspaceState<Real>& workspace, const Solve& solve) {
  const Team team(executor);
  const PieceSettings settings = {.size = piece_size(executor, mesh.face_count(), {4096, 64})};
  if (is_one_piece(settings.size, mesh.face_count())) {
    drive<kLabels>(Serial{}, mesh, sources, options, workspace, solve);
    return;
  }
  workspace.front.reserve(mesh.face_count());
  const DualQueue<Real> queue(workspace.front, std::numeric_limits<Real>::infinity());
  const TeamScheduler<Real, kLabels> scheduler(team, workspace, step_of<Real>(options), mesh.unit(),
                                               options);
  team.hold([&] { solve(queue, PieceScheduler<Real, kLabels>(scheduler, mesh, settings)); });
}

/// Calls `solve` with std::true_type where vertices have labels: from more than one source.
template <class Solve>
void with_labels(std::span<const PointSource> sources, const Solve& solve) {
  if (sources.size() > 1)
    solve(std::true_type{});
  else
    solve(std::false_type{});
}

}  // namespace plexway
