#pragma once

#include <cstddef>

#include <plexway/cloud/point_cloud.hpp>
#include <plexway/common/ids.hpp>
#include <plexway/shape/cloud_shape.hpp>

namespace plexway::detail {

/// Triangles of a cloud's sheet that lie over gaps.
struct BridgedGaps {
  std::size_t triangles = 0;  ///< 0: none
  Index first = none;         ///< the lowest of their points
};

/// Where the sheet of evenly spaced points bridges a gap such as a slit. An edge over a gap is at
/// least 1.9 times as long as it is from its ends to neighbours that lie onward (within 60
/// degrees), which no edge is in rows of points far apart and at steps in density. Chance makes
/// such edges too, up to 14 in a row among 40,000 points; counted are triangles with two of them
/// that come 24 in a row, and from 65,536 points on 3 more for each factor of four. Points that are
/// scattered as by chance are not looked at. Cost: linear.
template <class Real>
[[nodiscard]] BridgedGaps bridged_gaps(const CloudShape& shape, const PointCloud<Real>& cloud);

extern template BridgedGaps bridged_gaps(const CloudShape&, const PointCloud<float>&);
extern template BridgedGaps bridged_gaps(const CloudShape&, const PointCloud<double>&);

}  // namespace plexway::detail
