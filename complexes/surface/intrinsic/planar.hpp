#pragma once

#include <array>
#include <cmath>
#include <cstddef>

namespace plexway::detail {

/// An angle by its cosine and sine.
struct Turn {
  double c = 1, s = 0;
};

/// Keeps c^2 + s^2 = 1 where it nearly is.
[[nodiscard]] inline Turn normalised(Turn t) {
  const double rest = (3 - (t.c * t.c + t.s * t.s)) / 2;
  return {t.c * rest, t.s * rest};
}
[[nodiscard]] inline Turn sum(Turn a, Turn b) {
  return normalised({a.c * b.c - a.s * b.s, a.s * b.c + a.c * b.s});
}
[[nodiscard]] inline Turn difference(Turn a, Turn b) {
  return normalised({a.c * b.c + a.s * b.s, a.s * b.c - a.c * b.s});
}
/// From 0 to pi: what rounding put beyond goes back.
[[nodiscard]] inline Turn clamped(Turn t) { return t.s >= 0 ? t : Turn{t.c < 0 ? -1.0 : 1.0, 0.0}; }
/// pi minus an angle.
[[nodiscard]] inline Turn supplement(Turn t) { return {-t.c, t.s}; }
[[nodiscard]] inline Turn half(Turn t) {
  return normalised({std::sqrt(std::fmax(1 + t.c, 0) / 2), std::sqrt(std::fmax(1 - t.c, 0) / 2)});
}

/// A point of a plane.
struct Planar {
  double x = 0, y = 0;
};
[[nodiscard]] inline Planar operator+(Planar a, Planar b) { return {a.x + b.x, a.y + b.y}; }
[[nodiscard]] inline Planar operator-(Planar a, Planar b) { return {a.x - b.x, a.y - b.y}; }
[[nodiscard]] inline Planar operator*(double s, Planar a) { return {s * a.x, s * a.y}; }
[[nodiscard]] inline double dot(Planar a, Planar b) { return a.x * b.x + a.y * b.y; }
[[nodiscard]] inline double cross(Planar a, Planar b) { return a.x * b.y - a.y * b.x; }
[[nodiscard]] inline double norm(Planar a) { return std::hypot(a.x, a.y); }

/// The angle from a to b, in [0, pi] up to rounding; no angle where one has no length.
[[nodiscard]] inline Turn turn_between(Planar a, Planar b) {
  const double c = dot(a, b), s = cross(a, b), n = std::hypot(c, s);
  return n > 0 ? Turn{c / n, s / n} : Turn{};
}

/// Barycentric coordinates, not clamped. Measured off the longest edge, so that the point they make
/// is the one given up to rounding even where the triangle has hardly any height: then only the
/// height is in doubt.
[[nodiscard]] inline std::array<double, 3> barycentric(const std::array<Planar, 3>& corner,
                                                       Planar p) {
  std::size_t base = 0;
  double longest = -1;
  for (std::size_t i = 0; i < 3; ++i)
    if (const double l = norm(corner[(i + 1) % 3] - corner[i]); l > longest) longest = l, base = i;
  const std::size_t end = (base + 1) % 3, apex = (base + 2) % 3;
  std::array<double, 3> b{};
  b[base] = 1;
  if (!(longest > 0)) return b;
  const Planar e = 1 / longest * (corner[end] - corner[base]);
  const Planar to_p = p - corner[base], to_apex = corner[apex] - corner[base];
  const double height = cross(e, to_apex);
  b[apex] = height > 0 ? cross(e, to_p) / height : 0;
  b[end] = (dot(e, to_p) - b[apex] * dot(e, to_apex)) / longest;
  b[base] = 1 - b[apex] - b[end];
  return b;
}

/// The same, of a point that is in the triangle but for rounding: >= 0, sum 1.
[[nodiscard]] inline std::array<double, 3> clamped(std::array<double, 3> b) {
  double total = 0;
  for (double& x : b) total += x = std::fmax(x, 0);
  if (total != 1)
    for (double& x : b) x /= total;
  return b;
}

}  // namespace plexway::detail
