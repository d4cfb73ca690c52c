#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include <plexway/cloud/point_cloud.hpp>
#include <plexway/common/rows_of.hpp>
#include <plexway/paths/path_field.hpp>
#include <plexway/solve.hpp>
#include <plexway/source/source_list.hpp>

namespace plexway {

/// A distance field on a cloud of points that traces paths: along the sheet of triangles that
/// the cloud holds.
///
/// @code
///   PathField field(cloud, points);
///   field.solve(Serial{}, 0);
///   Path path = field.trace(17);
///
/// @endcode
/// Sources and targets are points. Those of a path in between are points of the sheet's triangles:
/// their simplices are numbers of `cloud.surface()`, whose corners `corners` has. The cloud and
/// its points are referred to and must outlive it, unless these would be gone after the line
/// (Given).
template <class Real>
class PathField<PointCloud<Real>> {
 public:
  /// `points` are those that the cloud was made from; with them paths have coordinates. Throws
  /// UsageError for another count. Cost: linear; 4 bytes a point, 24 more where some triangles hang
  /// together by a single edge.
  ///
  /// Lengths are in space, in double, and where noise was taken from them as the cloud has them.
  explicit PathField(const PointCloud<Real>& cloud, GivenPoints points = {});
  /// The cloud would be gone after this line.
  explicit PathField(const PointCloud<Real>&& cloud, GivenPoints points = {}) = delete;

  /// The distance of every point from the nearest of `sources`, points only. Throws and costs as
  /// `solve`.
  template <class Executor>
  const DistanceField<Real>& solve(Executor executor, const SourceList& sources,
                                   const PropagateOptions& options = {}) {
    const std::span<const PointSource> points = points_of(Purpose::paths, sources);
    solved_ = false;
    if constexpr (std::is_same_v<WorkspaceOf<Executor, PointCloud<Real>>, Workspace<Real>>)
      plexway::solve(executor, *cloud_, points, options, workspace_, field_);
    else
      field_ = plexway::solve(executor, *cloud_, points, options);
    took(points, options.visibility);
    return field_;
  }

  /// The field of the last solve.
  [[nodiscard]] const DistanceField<Real>& distances() const { return field_; }

  /// The path from a point of the cloud back to its nearest source, as on surfaces. Throws
  /// UsageError for a place that is not a point by number, or before a solve. Any number of threads
  /// may trace at once.
  [[nodiscard]] Path trace(const PointSource& point, const TraceOptions& options = {}) const;
  /// From a point by number.
  [[nodiscard]] Path trace(Index point, const TraceOptions& options = {}) const {
    return trace(PointSource::at(point), options);
  }

  /// The corners of a path's simplex: points, or behind them `cloud.more_places()`.
  [[nodiscard]] std::array<Index, 3> corners(Index simplex) const;

  /// Bytes held, without those of the cloud and its points.
  [[nodiscard]] std::size_t bytes() const;

 private:
  void took(std::span<const PointSource> sources, Visibility visibility);

  const PointCloud<Real>* cloud_;
  GivenPoints places_;     // of the sheet's vertices, or none
  bool in_space_ = false;  // are lengths those between places?
  std::vector<Index> outer_;
  Workspace<Real> workspace_;
  DistanceField<Real> field_, sheet_;  // at the points, and at the sheet's vertices if more
  std::vector<PointSource> sources_;
  Visibility visibility_ = Visibility::saddles;
  bool solved_ = false;
};

extern template class PathField<PointCloud<float>>;
extern template class PathField<PointCloud<double>>;

}  // namespace plexway
