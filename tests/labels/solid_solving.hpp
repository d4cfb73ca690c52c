#pragma once

#include <cmath>
#include <vector>

#include <plexway/solve.hpp>

#include "complexes/test_solids.hpp"
#include "labels/solving.hpp"

namespace plexway::testing {

inline constexpr Visibility solid_visibilities[] = {Visibility::saddles, Visibility::centroid,
                                                    Visibility::upper_bound};

template <class Real>
std::vector<double> solve(const TetMesh<Real>& mesh, const PointSource& source,
                          const PropagateOptions& options = {}) {
  const auto field = plexway::solve(Serial{}, mesh, source, options);
  return {field.distance.begin(), field.distance.end()};
}

/// Distances around straight edges along z over some ways through the plane.
inline double over(double flat, double z) { return std::hypot(flat, z); }

}  // namespace plexway::testing
