#pragma once

#include <span>

#include <plexway/solve.hpp>

#include "executors/drive.hpp"
#include "executors/solve_solid.hpp"
#include "executors/solve_surface.hpp"

/// A device's rounds, by a team on processors, where OpenMP goes by pieces.
namespace plexway::testing {

template <class Mesh>
DistanceField<float> solve_in_rounds(const Mesh& mesh, std::span<const PointSource> sources,
                                     const PropagateOptions& options) {
  Workspace<float> kept;
  WorkspaceState<float>& workspace = kept.state();
  DistanceField<float> field;
  with_labels(sources, [&](auto labels) {
    constexpr bool kLabels = decltype(labels)::value;
    drive_in_rounds<kLabels>(OpenMP{.threads = 2}, mesh, sources, options, workspace,
                             [&](auto queue, const auto& crew) {
                               if constexpr (requires { mesh.tet_count(); })
                                 solid::solve_with<float, kLabels>(mesh, sources, options,
                                                                   workspace, queue, crew, field);
                               else
                                 surface::solve_with<float, kLabels>(mesh, sources, options,
                                                                     workspace, queue, crew, field);
                             });
  });
  return field;
}

}  // namespace plexway::testing
