#pragma once

#include <string>
#include <vector>

#include <plexway/executors/window_solver.hpp>

#include "propagate/solving.hpp"

namespace plexway::testing {

inline constexpr Accuracy window_accuracies[] = {Accuracy::exact(), Accuracy::accurate()};

inline std::string name(Accuracy accuracy) {
  return accuracy == Accuracy::exact() ? "exact" : std::to_string(accuracy.error());
}

template <class Real>
std::vector<double> solve_windows(const TriangleMesh<Real>& mesh,
                                  const std::vector<PointSource>& sources, Accuracy accuracy,
                                  const PropagateOptions& options = {}) {
  WindowSolver<Real> solver(mesh);
  DistanceField<Real> field;
  solver.solve(sources, accuracy, options, field);
  return {field.distance.begin(), field.distance.end()};
}

}  // namespace plexway::testing
