#pragma once

#include <span>

#include <plexway/solve/distance_field.hpp>
#include <plexway/solve/options.hpp>
#include <plexway/source/point_source.hpp>
#include <plexway/wireframe/wireframe.hpp>

#include "labels/workspace_state.hpp"

namespace plexway {

/// On one thread, from sources that were checked.
template <class Real>
void solve_alone(const Wireframe<Real>& wireframe, std::span<const PointSource> sources,
                 const PropagateOptions& options, WorkspaceState<Real>& workspace,
                 DistanceField<Real>& field);

}  // namespace plexway
