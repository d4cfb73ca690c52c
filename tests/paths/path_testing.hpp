#pragma once

#include <algorithm>
#include <array>
#include <catch2/catch.hpp>
#include <cmath>
#include <cstddef>
#include <span>

#include <plexway/paths/path_field.hpp>
#include <plexway/solve.hpp>

#include "complexes/test_meshes.hpp"

namespace plexway::testing {
using namespace detail;

inline double apart(const Position& p, const Position& q) {
  return std::hypot(q[0] - p[0], q[1] - p[1], q[2] - p[2]);
}

inline Position place(std::span<const Position> positions, std::span<const Index> corners,
                      const std::array<double, 4>& b) {
  Position p = {0, 0, 0};
  for (std::size_t i = 0; i < corners.size(); ++i)
    for (std::size_t k = 0; k < 3; ++k) p[k] += b[i] * positions[corners[i]][k];
  return p;
}

/// How far p is from a triangle, by projection on its plane and its edges.
inline double off_triangle(const Position& p, const Position& a, const Position& b,
                           const Position& c) {
  using V = Vector3<double>;
  const V o = {a[0], a[1], a[2]}, u = V{b[0], b[1], b[2]} - o, v = V{c[0], c[1], c[2]} - o;
  const V q = V{p[0], p[1], p[2]} - o, n = cross(u, v);
  const double nn = dot(n, n);
  if (nn > 0) {
    const double s = dot(cross(q, v), n) / nn, t = dot(cross(u, q), n) / nn;
    if (s >= 0 && t >= 0 && s + t <= 1) return std::abs(dot(q, n)) / std::sqrt(nn);
  }
  const auto segment = [&](const V& from, const V& along) {
    const double l2 = dot(along, along);
    const double at = l2 > 0 ? std::clamp(dot(q - from, along) / l2, 0., 1.) : 0;
    return norm(q - from - at * along);
  };
  return std::min({segment({0, 0, 0}, u), segment({0, 0, 0}, v), segment(u, v - u)});
}

/// How far p is outside of a tetrahedron: the least of all if it is inside, in its own coordinates.
inline double off_tet(const Position& p, const std::array<Position, 4>& c) {
  using V = Vector3<double>;
  const auto at = [](const Position& x) { return V{x[0], x[1], x[2]}; };
  const V o = at(c[0]), u = at(c[1]) - o, v = at(c[2]) - o, w = at(c[3]) - o, q = at(p) - o;
  const double volume = dot(u, cross(v, w));
  const double b1 = dot(q, cross(v, w)) / volume, b2 = dot(q, cross(w, u)) / volume,
               b3 = dot(q, cross(u, v)) / volume;
  return std::max(0., -std::min({b1, b2, b3, 1 - b1 - b2 - b3}));
}

/// The path's own promises, by explicit geometry: its points are where their coordinates say, each
/// line lies in the simplex of its first point, and the length is that of the lines.
template <class Simplices>
void check_path(const Path& path, std::span<const Position> positions, const Simplices& simplices,
                double size = 1) {
  REQUIRE(path.points.size() == path.positions.size());
  REQUIRE_FALSE(path.points.empty());
  double length = 0, off = 0, misplaced = 0;
  bool proper = true;
  for (std::size_t i = 0; i < path.points.size(); ++i) {
    const PathPoint& p = path.points[i];
    REQUIRE(p.simplex < simplices.size());
    const auto& corners = simplices[p.simplex];
    double sum = 0;
    for (std::size_t k = 0; k < 4; ++k) {
      proper = proper && p.barycentric[k] >= 0 && (k < corners.size() || p.barycentric[k] == 0);
      sum += p.barycentric[k];
    }
    proper = proper && std::abs(sum - 1) < 1e-9;
    misplaced =
        std::max(misplaced, apart(place(positions, corners, p.barycentric), path.positions[i]));
    if (i + 1 == path.points.size()) break;
    length += apart(path.positions[i], path.positions[i + 1]);
    const Position& next = path.positions[i + 1];
    if constexpr (std::tuple_size_v<std::decay_t<decltype(corners)>> == 3)
      off = std::max(off, off_triangle(next, positions[corners[0]], positions[corners[1]],
                                       positions[corners[2]]));
    else if constexpr (std::tuple_size_v<std::decay_t<decltype(corners)>> == 4)
      off = std::max(off, off_tet(next, {positions[corners[0]], positions[corners[1]],
                                         positions[corners[2]], positions[corners[3]]}));
  }
  CHECK(proper);
  CHECK(misplaced <= 1e-9 * size);
  CHECK(off <= 1e-8 * size);
  CHECK(path.length == Approx(length).epsilon(1e-12).margin(1e-14));
}

/// A random point of a random simplex.
template <class Simplices>
PointSource anywhere(const Simplices& simplices, std::mt19937& random) {
  PointSource p;
  p.simplex = below(random, simplices.size());
  double sum = 0;
  const std::size_t corners = simplices[0].size();
  for (std::size_t i = 0; i < corners; ++i) sum += p.barycentric[i] = 0.05 + uniform(random);
  for (std::size_t i = 0; i < corners; ++i) p.barycentric[i] /= sum;
  return p;
}

}  // namespace plexway::testing
