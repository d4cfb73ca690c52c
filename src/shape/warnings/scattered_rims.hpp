#pragma once

#include <cstddef>
#include <span>

#include <plexway/cloud/point_cloud.hpp>
#include <plexway/common/ids.hpp>
#include <plexway/shape/cloud_shape.hpp>

namespace plexway {

/// Where a cloud whose points are scattered as by chance has a rim that paths bend around.
struct ScatteredRims {
  std::size_t points = 0;  ///< of the rim; 0: none, or the points are spaced evenly
  Index first = none;      ///< the lowest of them
};

/// Points of which the nearest neighbour is as often much nearer or farther than usual as by chance
/// leave voids of two to four spacings, so a rim of theirs is only known to about that. It does no
/// harm where the rim is convex. Those are counted where it is not: eight spacings before and
/// behind such a point the rim has turned by 50 degrees or more, and the sheet there has more than
/// half a turn by as much. Cost: linear.
template <class Real>
[[nodiscard]] ScatteredRims scattered_rims(const CloudShape& shape, const PointCloud<Real>& cloud);

extern template ScatteredRims scattered_rims(const CloudShape&, const PointCloud<float>&);
extern template ScatteredRims scattered_rims(const CloudShape&, const PointCloud<double>&);

}  // namespace plexway
