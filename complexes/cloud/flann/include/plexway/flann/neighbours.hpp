#pragma once

#include <cstddef>
#include <functional>
#include <limits>
#include <optional>

#include <plexway/cloud/neighbours.hpp>
#include <plexway/common/rows_of.hpp>

/// The component `flann`, link plexway::flann: neighbours of points, by FLANN.
namespace plexway::flann {

/// Who counts as a neighbour.
struct NeighbourOptions {
  std::size_t k = 16;  ///< at most so many; 0: all within the radius
  /// Only those at most so far away (the points' unit), > 0.
  double radius = std::numeric_limits<double>::infinity();
  bool symmetric = true;  ///< who is a neighbour has the point as a neighbour, too
  int threads = 0;        ///< 0: as many as the machine has
  /// Called with the share that is done; returning false stops with Cancelled.
  std::function<bool(double share)> progress = {};
};

/// The nearest neighbours of each point among all points, by FLANN's single k-d tree, which is
/// exact.
///
/// Points at one place count as one: its first point has the neighbours, any other point there has
/// this first one as its only neighbour (distance 0). So k equal points more do not hide the rest.
/// Rows are nearest first, the lower number first of two equally near. A point has fewer than k
/// neighbours where there are not enough others (k >= n is fine); with `symmetric` it may have
/// more.
///
/// Throws InputError naming the point for a coordinate that is not finite, UsageError for a radius
/// that is not > 0, or for neither k nor radius; Cancelled as progress says. The result does not
/// depend on the number of threads. Cost: n log n; 2 to 3 us a point for k = 16 on one thread.
[[nodiscard]] Neighbours neighbours(const GivenPoints& points,
                                    const NeighbourOptions& options = {});

/// Neighbours to make a PointCloud of. As above, but for two things that k nearest points do not
/// tell of a surface:
///
/// Where the k nearest lie in one row of a scan, the list goes on until it has neighbours on both
/// sides of the row, as long as that takes no more than 16 k. Points that are nearer to each other
/// than a ten-thousandth of the distance to the next count as one (`without_near_twins`), so that
/// they do not hide the rest.
///
/// Cost: 1.1 times as much; where rows are far apart, as for the k that it takes.
[[nodiscard]] Neighbours surface_neighbours(const GivenPoints& points,
                                            const NeighbourOptions& options = {});

/// The smallest k with which all points are connected over neighbours, or nothing if it is above
/// `most`. Radius and symmetry of `options` do not count. Throws as above. Cost: as for a search
/// with twice the k that is found, and all smaller powers of two.
[[nodiscard]] std::optional<std::size_t> connecting_k(const GivenPoints& points,
                                                      std::size_t most = 256,
                                                      const NeighbourOptions& options = {});

}  // namespace plexway::flann
