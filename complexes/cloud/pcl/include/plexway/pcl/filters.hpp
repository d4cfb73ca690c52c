#pragma once

#include <array>
#include <span>
#include <vector>

#include <plexway/common/ids.hpp>

namespace plexway::pcl {

/// One point for each cube of side `size` that has any: their mean, by pcl::VoxelGrid. The order is
/// that of the cubes. PCL computes in single precision; here that is relative to the middle of the
/// cloud and its extent, so an offset of the whole cloud costs nothing.
///
/// Throws UsageError for a size that is not a number above 0, or so small that the box around the
/// cloud has more than 2^31 - 1 cubes (the message says which would do), and InputError for points
/// that are not finite.
std::vector<std::array<double, 3>> voxel_grid(std::span<const std::array<double, 3>> points,
                                              double size);

/// What counts as an outlier.
struct OutlierOptions {
  /// So many nearest points are looked at, at least 1.
  int neighbours = 8;
  /// A point is an outlier where the mean distance to its neighbours is that many standard
  /// deviations above the mean of all. Of 20000 evenly scattered points 0.4 % are at 3, 3 % at 2
  /// and 16 % at 1; of 200 more anywhere in the box around a sphere 49, 39 and 25 stay.
  double deviations = 3;
};

/// Numbers of the points that are no outliers, ascending, by pcl::StatisticalOutlierRemoval. Throws
/// UsageError for options out of range, InputError for points that are not finite. Cost: a k-d tree
/// and a search a point.
std::vector<Index> without_outliers(std::span<const std::array<double, 3>> points,
                                    const OutlierOptions& options = {});

}  // namespace plexway::pcl
