#include "shape/warnings/cloud_slopes.hpp"

#include <algorithm>
#include <cmath>

#include "complexes/common/point3.hpp"

namespace plexway {
namespace {

// Least squares in the plane across the normal; at most twice as steep as the steepest way to a
// neighbour, for neighbours that all but lie in a line tell nothing about the way across it.
Point3 slope(Index i, std::span<const Point3> points, const Point3& normal,
             std::span<const Index> around, std::span<const double> value) {
  const Point3 x = some_perpendicular(normal), y = cross(normal, x);
  double xx = 0, xy = 0, yy = 0, xv = 0, yv = 0, steepest = 0;
  for (const Index n : around) {
    const double rise = value[n] - value[i];
    if (!std::isfinite(rise)) continue;
    const Point3 to = minus(points[n], points[i]);
    const double a = dot(to, x), b = dot(to, y);
    xx += a * a, xy += a * b, yy += b * b;
    xv += a * rise, yv += b * rise;
    if (const double length = std::sqrt(dot(to, to)); length > 0)
      steepest = std::max(steepest, std::abs(rise) / length);
  }
  const double determinant = xx * yy - xy * xy;
  if (!(determinant > 1e-6 * (xx + yy) * (xx + yy))) return {};
  double p = (yy * xv - xy * yv) / determinant, q = (xx * yv - xy * xv) / determinant;
  if (const double length = std::hypot(p, q); length > 2 * steepest)
    p *= 2 * steepest / length, q *= 2 * steepest / length;
  Point3 found;
  for (std::size_t k = 0; k < 3; ++k) found[k] = p * x[k] + q * y[k];
  return found;
}

}  // namespace

std::vector<std::array<double, 3>> cloud_slopes(std::span<const std::array<double, 3>> points,
                                                std::span<const std::array<double, 3>> normals,
                                                const Neighbours& neighbours,
                                                std::span<const double> value) {
  std::vector<std::array<double, 3>> found(points.size(), Point3{});
  for (std::size_t i = 0; i < points.size(); ++i) {
    const double length = std::sqrt(dot(normals[i], normals[i]));
    if (!(length > 0) || !std::isfinite(value[i])) continue;
    const auto point = static_cast<Index>(i);
    found[i] = slope(point, points, unit(normals[i]), neighbours.around(point), value);
  }
  return found;
}

}  // namespace plexway
