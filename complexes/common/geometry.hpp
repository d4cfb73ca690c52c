#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>

#include <plexway/common/ids.hpp>
#include <plexway/source/point_source.hpp>

namespace plexway::detail {

/// A point of a plane, such as the one that a strip of triangles is unfolded into.
struct Vector2 {
  double x = 0, y = 0;

  friend Vector2 operator+(const Vector2& a, const Vector2& b) { return {a.x + b.x, a.y + b.y}; }
  friend Vector2 operator-(const Vector2& a, const Vector2& b) { return {a.x - b.x, a.y - b.y}; }
  friend Vector2 operator*(double s, const Vector2& a) { return {s * a.x, s * a.y}; }
  friend double dot(const Vector2& a, const Vector2& b) { return a.x * b.x + a.y * b.y; }
  friend double cross(const Vector2& a, const Vector2& b) { return a.x * b.y - a.y * b.x; }
  friend double norm(const Vector2& a) { return std::sqrt(dot(a, a)); }
};

using Point3 = std::array<double, 3>;

inline Point3 minus(const Point3& a, const Point3& b) {
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}
inline Point3 cross(const Point3& a, const Point3& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
template <class A, class B>
double dot(const A& a, const B& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}
inline double norm(const Point3& a) { return std::sqrt(dot(a, a)); }
inline Point3 unit(const Point3& a) {
  const double length = norm(a);
  return {a[0] / length, a[1] / length, a[2] / length};
}
/// A unit vector across a, always the same for the same a.
inline Point3 some_perpendicular(const Point3& a) {
  std::size_t least = 0;
  for (std::size_t d = 1; d < 3; ++d)
    if (std::abs(a[d]) < std::abs(a[least])) least = d;
  Point3 axis{};
  axis[least] = 1;
  return unit(cross(a, axis));
}

/// The axes of a set of points: orthonormal, the direction of least spread first.
struct LocalFrame {
  std::array<double, 3> normal = {0, 0, 1}, u = {1, 0, 0}, v = {0, 1, 0};
  /// Share of the spread along the normal: 0 flat, 1/3 the same in all directions.
  double variation = 0;
};

/// The principal axes of n offsets from a point, the point itself with weight 1 and each offset
/// with its own. With the offsets in one line the normal is any direction across it; without
/// offsets it is the z axis. Offsets are finite.
LocalFrame fit_frame(std::span<const std::array<double, 3>> offsets,
                     std::span<const double> weights);

/// A point of a simplex.
struct SimplexPoint {
  std::size_t simplex = 0;
  /// Of its corners: >= 0, sum 1; 0 beyond them.
  std::array<double, 4> barycentric = {1, 0, 0, 0};
  /// From the point asked for, in a unit that depends on that and the positions alone.
  double squared_distance = std::numeric_limits<double>::infinity();
};

/// As a source: a corner where it is nearer to that than a rounding error of the coordinates.
PointSource source_at(const SimplexPoint& found, std::span<const Index> corners);

/// The point of some simplices that is closest to `point`, finite coordinates: of tetrahedra that
/// is the point itself where it lies inside. Among equally close ones, the one of the first
/// simplex. Cost: one pass over the simplices.
SimplexPoint closest_point(std::span<const std::array<double, 3>> positions,
                           std::span<const std::array<std::uint32_t, 2>> edges,
                           const std::array<double, 3>& point);
SimplexPoint closest_point(std::span<const std::array<double, 3>> positions,
                           std::span<const std::array<std::uint32_t, 3>> triangles,
                           const std::array<double, 3>& point);
SimplexPoint closest_point(std::span<const std::array<double, 3>> positions,
                           std::span<const std::array<std::uint32_t, 4>> tets,
                           const std::array<double, 3>& point);

/// Squared distance of the origin from a triangle, which may have no area. Corners of about 1.
double squared_distance(const std::array<std::array<double, 3>, 3>& corners);

}  // namespace plexway::detail
