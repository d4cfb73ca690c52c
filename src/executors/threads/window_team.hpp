#pragma once

#include <span>

#include <plexway/executors.hpp>
#include <plexway/solve/accuracy.hpp>
#include <plexway/solve/distance_field.hpp>
#include <plexway/solve/options.hpp>
#include <plexway/source/point_source.hpp>
#include <plexway/surface/triangle_mesh.hpp>

#include "labels/workspace_state.hpp"

namespace plexway {

/// WindowSolver::solve_by with a team, in pieces, the same result whatever the number of threads:
/// in a single piece, or in an order that pieces cannot keep, by one thread.
template <class Real>
[[nodiscard]] bool solve_by_windows(const OpenMP& executor, const TriangleMesh<Real>& mesh,
                                    std::span<const PointSource> sources, Accuracy accuracy,
                                    const PropagateOptions& options,
                                    WorkspaceState<Real>& workspace, DistanceField<Real>& field);

}  // namespace plexway
