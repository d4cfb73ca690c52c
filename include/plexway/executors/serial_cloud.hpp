#pragma once

#include <span>

#include <plexway/complex/point_cloud.hpp>
#include <plexway/executors/serial.hpp>

namespace plexway {

/// The distance of every point of a cloud from the nearest of `sources`, which are points by number
/// (PointSource::at).
///
/// As on a surface: workspace, errors, bits and allocations. Points at one place have one distance;
/// points that no path reaches have +inf. Throws UsageError for a source that is not a point of the
/// cloud. Cost: 100 to 160 ns a point.
template <class Real>
void propagate(Serial, const PointCloud<Real>& cloud, std::span<const PointSource> sources,
               const PropagateOptions& options, Workspace<Real>& workspace,
               DistanceField<Real>& field);

/// The same with a workspace of its own.
template <class Real>
[[nodiscard]] DistanceField<Real> propagate(Serial executor, const PointCloud<Real>& cloud,
                                            std::span<const PointSource> sources,
                                            const PropagateOptions& options = {});

/// From a single source.
template <class Real>
[[nodiscard]] DistanceField<Real> propagate(Serial executor, const PointCloud<Real>& cloud,
                                            const PointSource& source,
                                            const PropagateOptions& options = {}) {
  return propagate(executor, cloud, std::span<const PointSource>(&source, 1), options);
}

}  // namespace plexway
