#pragma once

#include <string>
#include <vector>

#include <plexway/executors/window_solver.hpp>

#include "propagate/solving.hpp"

namespace plexway::testing {

inline constexpr Accuracy window_accuracies[] = {Accuracy::exact};

inline std::string name(Accuracy accuracy) {
  static const char* const names[] = {"fast", "accurate", "exact"};
  return names[static_cast<int>(accuracy)];
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
