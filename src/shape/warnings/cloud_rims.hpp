#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include <plexway/cloud/point_cloud.hpp>
#include <plexway/common/ids.hpp>
#include <plexway/shape/cloud_shape.hpp>

namespace plexway::detail {

/// Points of a cloud that came out farther than straight where the cloud is flat.
struct RimDetours {
  std::size_t points = 0;
  std::size_t first = 0;  ///< the lowest of them
  double most = 0;        ///< the largest share by which one is farther
  bool all = true;        ///< else there may be more
};

/// Those three to 25 spacings from a source and a twentieth to a half farther than straight, where
/// all that lies near the straight line lies in one plane with it: the way goes around a notch in
/// the rim, or a void. Whether the surface ends there only who has it can tell. What is farther yet
/// is behind a wall. Up to 16 sources are looked at, and none among more than 10,000 points (where
/// the cloud is so much denser than in the mean, its spacing is not what is requested), nor one
/// whose neighbours lie in a line. Cost: for each a look at all points, and at those around it for
/// each of up to 64 that are farther, evenly among them if there are more.
[[nodiscard]] RimDetours rim_detours(std::span<const std::array<double, 3>> positions,
                                     double spacing, std::span<const double> distance,
                                     std::span<const std::size_t> sources);

/// The distance of each point to the nearest of its neighbours; 0 where there is none.
[[nodiscard]] std::vector<double> nearest_neighbours(const CloudShape& shape);
/// Are they as uneven as by chance?
[[nodiscard]] bool is_scattered(std::span<const double> nearest);

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
