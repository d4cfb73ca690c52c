#pragma once

#include <cstddef>
#include <functional>
#include <span>
#include <vector>

#include <plexway/cloud/point_cloud.hpp>
#include <plexway/solid/tet_mesh.hpp>
#include <plexway/solve.hpp>
#include <plexway/solve/distance_field.hpp>
#include <plexway/source/point_source.hpp>
#include <plexway/surface/triangle_mesh.hpp>

namespace plexway {

/// Distances between chosen points.
struct DistanceMatrix {
  /// So many points.
  std::size_t size = 0;
  std::vector<double> distance;  ///< row by row, symmetric, 0 on the diagonal; +inf where no path
  /// The largest difference between the two ways, in the length of the way: an error estimate.
  double asymmetry = 0;
  Accuracy accuracy = Accuracy::fast();  ///< by which it was solved
  /// Of all propagations.
  PropagateStatistics statistics;

  /// From point i to point j, both < size.
  [[nodiscard]] double operator()(std::size_t i, std::size_t j) const {
    return distance[i * size + j];
  }
};

/// All pairs among `points`: one propagation a point, no farther than the triangle inequality and
/// the rows already known say is needed, read out at the points only. Of the two ways the shorter
/// counts. Offsets are not asked for (UsageError).
///
/// Throws UsageError for no points or a point that is not in the domain, and Cancelled when
/// `progress`, called with the share that is done, returns false. The accuracy is that of `solve`.
/// UsageError for a surface with refracting edges, too.
template <class Real>
[[nodiscard]] DistanceMatrix distance_matrix(Serial, const TriangleMesh<Real>& mesh,
                                             std::span<const PointSource> points,
                                             const std::function<bool(double share)>& progress = {},
                                             Accuracy accuracy = Accuracy::usual());
/// In a solid, which must have coordinates (UsageError).
template <class Real>
[[nodiscard]] DistanceMatrix distance_matrix(Serial, const TetMesh<Real>& mesh,
                                             std::span<const PointSource> points,
                                             const std::function<bool(double share)>& progress = {},
                                             Accuracy accuracy = Accuracy::usual());
/// Among points of a cloud, by number.
template <class Real>
[[nodiscard]] DistanceMatrix distance_matrix(Serial, const PointCloud<Real>& cloud,
                                             std::span<const PointSource> points,
                                             const std::function<bool(double share)>& progress = {},
                                             Accuracy accuracy = Accuracy::usual());

}  // namespace plexway
