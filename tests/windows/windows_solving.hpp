#pragma once

#include <catch2/catch.hpp>
#include <span>
#include <string>
#include <type_traits>
#include <vector>

#include "labels/solving.hpp"
#include "labels/workspace_state.hpp"
#include "windows/window_solver.hpp"

namespace plexway::testing {
using namespace detail;

inline constexpr Accuracy window_accuracies[] = {Accuracy::exact(), Accuracy::accurate()};

inline std::string name(Accuracy accuracy) {
  return accuracy == Accuracy::exact() ? "exact" : std::to_string(accuracy.error());
}

/// As plexway::solve; and exactly in single precision, which that refuses: merged windows come to
/// it where they give up.
template <class Real>
void solve_windows(const TriangleMesh<Real>& mesh, std::span<const PointSource> sources,
                   Accuracy accuracy, PropagateOptions options, Workspace<Real>& workspace,
                   DistanceField<Real>& field) {
  options.accuracy = accuracy;
  if (std::is_same_v<Real, float> && accuracy == Accuracy::exact()) {
    WorkspaceState<Real>& state = workspace.state();
    const bool solved =
        state.windows.on(mesh).solve_by(Alone{}, sources, accuracy, options, state, field);
    CHECK(solved);
  } else {
    plexway::solve(Serial{}, mesh, sources, options, workspace, field);
  }
}

template <class Real>
std::vector<double> solve_windows(const TriangleMesh<Real>& mesh,
                                  const std::vector<PointSource>& sources, Accuracy accuracy,
                                  const PropagateOptions& options = {}) {
  Workspace<Real> workspace;
  DistanceField<Real> field;
  solve_windows(mesh, sources, accuracy, options, workspace, field);
  return {field.distance.begin(), field.distance.end()};
}

}  // namespace plexway::testing
