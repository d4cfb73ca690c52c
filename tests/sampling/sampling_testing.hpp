#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include <plexway/source/point_source.hpp>

#include "data/shapes.hpp"

namespace sampling_testing {

using plexway::Index;
using plexway::PointSource;
using Point = std::array<double, 3>;

/// A square of side 1 with n x n cells, its inner points moved about.
inline samples::Shape square(Index n, double jitter = 0.25) {
  samples::Shape shape =
      samples::jittered_square(n, 1, jitter, 7, [](Index, Index) { return false; });
  samples::add_square_faces(shape, n, [](Index, Index) { return true; });
  return shape;
}

template <std::size_t N>
Point position(const PointSource& p, const std::vector<Point>& points,
               const std::vector<std::array<Index, N>>& simplices) {
  if (p.vertex != plexway::none) return points[p.vertex];
  Point at = {0, 0, 0};
  for (std::size_t i = 0; i < N; ++i)
    for (std::size_t k = 0; k < 3; ++k)
      at[k] += p.barycentric[i] * points[simplices[p.simplex][i]][k];
  return at;
}

template <std::size_t N>
std::vector<Point> positions(const std::vector<PointSource>& darts,
                             const std::vector<Point>& points,
                             const std::vector<std::array<Index, N>>& simplices) {
  std::vector<Point> at;
  for (const PointSource& dart : darts) at.push_back(position(dart, points, simplices));
  return at;
}

inline double euclid(const Point& a, const Point& b) {
  return std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]);
}
/// In samples::elbow_solid: around the edge x = y = 1 where the straight line leaves the L.
inline double inside_elbow(const Point& a, const Point& b) {
  const double side_a = a[0] - 1, up_a = a[1] - 1, side_b = b[0] - 1, up_b = b[1] - 1;
  const bool opposite = (side_a > 0 && up_b > 0) || (up_a > 0 && side_b > 0);
  const double turn = side_a * up_b - up_a * side_b;
  if (!(opposite && (side_a > 0 ? turn > 0 : turn < 0))) return euclid(a, b);
  return std::hypot(std::hypot(side_a, up_a) + std::hypot(side_b, up_b), a[2] - b[2]);
}
/// On the unit sphere.
inline double great_circle(const Point& a, const Point& b) {
  return 2 * std::asin(std::min(1., euclid(samples::unit(a), samples::unit(b)) / 2));
}

template <class Distance>
double least_distance(const std::vector<Point>& darts, Distance distance) {
  double least = 1e30;
  for (std::size_t i = 0; i < darts.size(); ++i)
    for (std::size_t j = 0; j < i; ++j) least = std::min(least, distance(darts[i], darts[j]));
  return least;
}

template <class Distance>
double nearest(const Point& at, const std::vector<Point>& darts, Distance distance) {
  double least = 1e30;
  for (const Point& dart : darts) least = std::min(least, distance(at, dart));
  return least;
}

}  // namespace sampling_testing
