#pragma once

#include <array>
#include <cmath>
#include <cstddef>

namespace plexway::detail {

/// A triangle by its lengths and angles, in double: what a TriangleRecord is rounded from.
struct TriangleShape {
  std::array<double, 3> length;  // edge i from corner i to the next
  std::array<double, 3> cosine;  // of the angle at corner i
  std::array<double, 3> sine;    // >= 0
  bool degenerate = false;       // no area
  bool violated = false;         // lengths break the triangle inequality
};

/// Angles for corners where an edge has no length: right angles, as in the limit of a thin
/// isosceles triangle; 60 degrees where both have none.
inline void set_limit_angle(TriangleShape& shape, std::size_t i) {
  const bool both = shape.length[i] == 0 && shape.length[(i + 2) % 3] == 0;
  shape.cosine[i] = both ? 0.5 : 0;
  shape.sine[i] = both ? std::sqrt(0.75) : 1;
}

/// From coordinates: angles by dot and cross products, so that thin triangles keep theirs.
inline TriangleShape shape_from_positions(const std::array<const std::array<double, 3>*, 3>& p) {
  TriangleShape shape{};
  std::array<std::array<double, 3>, 3> edge;
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t d = 0; d < 3; ++d) edge[i][d] = (*p[(i + 1) % 3])[d] - (*p[i])[d];
    shape.length[i] = std::hypot(edge[i][0], edge[i][1], edge[i][2]);
  }
  for (std::size_t i = 0; i < 3; ++i) {
    if (shape.length[i] == 0 || shape.length[(i + 2) % 3] == 0) {
      set_limit_angle(shape, i);
      shape.degenerate = true;
      continue;
    }
    std::array<double, 3> u, w;
    for (std::size_t d = 0; d < 3; ++d) {
      u[d] = edge[i][d] / shape.length[i];
      w[d] = -edge[(i + 2) % 3][d] / shape.length[(i + 2) % 3];
    }
    const double dot = u[0] * w[0] + u[1] * w[1] + u[2] * w[2];
    const double cross =
        std::hypot(u[1] * w[2] - u[2] * w[1], u[2] * w[0] - u[0] * w[2], u[0] * w[1] - u[1] * w[0]);
    const double norm = std::hypot(dot, cross);
    shape.cosine[i] = dot / norm;
    shape.sine[i] = cross / norm;
    if (shape.sine[i] < 1e-14) shape.degenerate = true;
  }
  return shape;
}

/// From lengths: Heron's formula in Kahan's order (Miscalculating Area and Angles of a Needle-like
/// Triangle). Where the triangle inequality fails the triangle is flat.
inline TriangleShape shape_from_lengths(const std::array<double, 3>& length) {
  TriangleShape shape{};
  shape.length = length;
  const double longest = std::fmax(std::fmax(length[0], length[1]), length[2]);
  // Fourth powers of these are no numbers.
  if (longest > 0 && !(longest > 1e-70 && longest < 1e70) && std::isfinite(longest)) {
    const int by = std::ilogb(longest);
    std::array<double, 3> near_one = length;
    for (double& l : near_one) l = std::scalbn(l, -by);
    shape = shape_from_lengths(near_one);
    shape.length = length;
    return shape;
  }
  for (std::size_t i = 0; i < 3; ++i) {
    const double b = length[i], c = length[(i + 2) % 3], a = length[(i + 1) % 3];
    if (b == 0 || c == 0) {
      set_limit_angle(shape, i);
      shape.degenerate = true;
      continue;
    }
    const double large = b < c ? c : b, small = b < c ? b : c;
    const double excess = small >= a ? a - (large - small) : small - (large - a);
    const double rest = (large - small) + a;  // the two factors of (a^2 - (b - c)^2)
    // Squares of sine and cosine of half the angle, but for a common factor.
    double inner = excess * rest, outer = (large + (small + a)) * ((large - a) + small);
    if (excess < 0 || outer < 0) shape.violated = true;
    if (inner <= 0 || outer <= 0) shape.degenerate = true;
    inner = inner > 0 ? inner : 0;
    outer = outer > 0 ? outer : 0;
    const double whole = inner + outer;
    shape.cosine[i] = whole > 0 ? (outer - inner) / whole : 1;
    shape.sine[i] = whole > 0 ? 2 * std::sqrt(inner * outer) / whole : 0;
  }
  return shape;
}

}  // namespace plexway::detail
