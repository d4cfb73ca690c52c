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

/// When there are enough points.
struct FarthestOptions {
  std::size_t count = 2;  ///< so many points, those that it starts from included
  /// Or fewer: stop when no vertex is farther than this from them.
  double radius = 0;
  /// Called now and then with the share that is done; false stops with Cancelled.
  std::function<bool(double share)> progress = {};
};

/// Points far from each other.
struct FarthestPoints {
  std::vector<PointSource> points;  ///< the given ones first, then vertices
  /// How far each was from those before it when it was chosen: +inf for the first ones of a
  /// component, then falling. 0 for those given.
  std::vector<double> distance;
  double covering = 0;  ///< no vertex is farther from the points; +inf where some are unreachable
  /// Of all propagations.
  PropagateStatistics statistics;
};

/// One vertex after the other, each the farthest from those before. Labels stay: a further point is
/// propagated only where it is the nearest, so that k points cost about ln k propagations from a
/// single source. Of vertices equally far, the lowest number comes first. Vertices in no simplex
/// are left out.
///
/// Throws UsageError for no start, a start that is not in the domain or options out of range.
/// UsageError for a surface with refracting edges, too.
template <class Real>
[[nodiscard]] FarthestPoints farthest_points(Serial, const TriangleMesh<Real>& mesh,
                                             std::span<const PointSource> start,
                                             const FarthestOptions& options);
/// In a solid, which must have coordinates (UsageError).
template <class Real>
[[nodiscard]] FarthestPoints farthest_points(Serial, const TetMesh<Real>& mesh,
                                             std::span<const PointSource> start,
                                             const FarthestOptions& options);
/// Among the points of a cloud; the start is points by number. Points that nothing is near are left
/// out.
template <class Real>
[[nodiscard]] FarthestPoints farthest_points(Serial, const PointCloud<Real>& cloud,
                                             std::span<const PointSource> start,
                                             const FarthestOptions& options);

}  // namespace plexway
