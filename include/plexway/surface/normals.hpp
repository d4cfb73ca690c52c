#pragma once

#include <array>
#include <vector>

#include <plexway/cloud/neighbours.hpp>
#include <plexway/common/rows_of.hpp>

namespace plexway {

/// The planes that fit the neighbourhoods of a cloud's points.
struct TangentPlanes {
  std::vector<std::array<double, 3>> normal;  ///< unit; which of the two signs is arbitrary
  /// How far from flat: the share of the spread that is along the normal (surface variation).
  /// 0 in a plane, 1/3 where there is no surface to be seen.
  std::vector<double> variation;
};

/// By principal components of each point and its neighbours, nearer ones with more weight (Pauly,
/// Gross, Kobbelt: Efficient Simplification of Point-Sampled Surfaces, Visualization 2002). A
/// normal is off by about the curvature times a quarter of the spacing on clean surfaces. Where
/// all neighbours are in one line it is any direction across it; without neighbours, the z axis.
///
/// Throws InputError naming the point for a coordinate that is not finite, and for lists that are
/// no neighbour lists of these points. The result does not depend on `threads` (0: all there are).
/// Cost: 1 us a point for 16 neighbours on one thread.
[[nodiscard]] TangentPlanes fit_planes(const GivenPoints& points, const Neighbours& neighbours,
                                       int threads = 0);

/// The normals alone.
[[nodiscard]] std::vector<std::array<double, 3>> estimate_normals(const GivenPoints& points,
                                                                  const Neighbours& neighbours,
                                                                  int threads = 0);

}  // namespace plexway
