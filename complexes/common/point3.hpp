#pragma once

#include <array>
#include <cmath>
#include <cstddef>

namespace plexway::detail {

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

}  // namespace plexway::detail
