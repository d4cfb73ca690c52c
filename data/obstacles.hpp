#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "shapes.hpp"

/// Round obstacles in solids, cut into facets as fine as the tetrahedra around them, and exact
/// distances. Their boundaries are for a tetrahedral mesher; any mesh of them will do.
namespace samples {

/// A straight prism over a regular polygon with a hole of the same form: what a pipe becomes in a
/// mesh. Paths bend at the inner wall's edges, and the exact distances are those of the prism, not
/// of the round pipe: its facets are no error.
struct PipePrism {
  Index sides;
  double inner = 0.5, outer = 1, height = 1;

  [[nodiscard]] Point corner(Index side, double radius, double z) const {
    const double angle = 2 * pi * side / sides;
    return {radius * std::cos(angle), radius * std::sin(angle), z};
  }
  /// Its volume.
  [[nodiscard]] double volume() const {
    return sides / 2.0 * std::sin(2 * pi / sides) * (outer * outer - inner * inner) * height;
  }
  /// So many sides that they are about as long as the edges of `tets` tetrahedra.
  static Index sides_for(double tets) {
    const double edge = std::cbrt(8.5 * pi * 0.75 / tets);
    return static_cast<Index>(std::lround(pi / edge));
  }

  /// Of points inside, from `source`.
  [[nodiscard]] std::vector<double> distances(const std::vector<Point>& points,
                                              Point source) const {
    std::vector<double> d;
    for (const Point& p : points) d.push_back(std::hypot(flat(source, p), p[2] - source[2]));
    return d;
  }

 private:
  // A half plane by a side: positive outside the inner polygon.
  [[nodiscard]] double beyond(Index side, Point p) const {
    const Point a = corner(side, inner, 0), b = corner(side + 1, inner, 0);
    return (b[1] - a[1]) * (p[0] - a[0]) - (b[0] - a[0]) * (p[1] - a[1]);
  }
  // In the plane: straight, or a taut string around the inner polygon either way.
  [[nodiscard]] double flat(Point p, Point q) const {
    double begin = 0, end = 1;  // the part of the line in the polygon
    for (Index i = 0; i < sides && begin < end; ++i) {
      const double at_p = beyond(i, p), at_q = beyond(i, q);
      if (at_p >= -rounding && at_q >= -rounding) return std::hypot(p[0] - q[0], p[1] - q[1]);
      if (at_p > 0 && at_q < 0) begin = std::max(begin, at_p / (at_p - at_q));
      if (at_p < 0 && at_q > 0) end = std::min(end, at_p / (at_p - at_q));
    }
    if (begin + rounding >= end) return std::hypot(p[0] - q[0], p[1] - q[1]);
    return std::min(around(p, q), around(q, p));
  }
  // Anticlockwise from p to q.
  [[nodiscard]] double around(Point p, Point q) const {
    const double side = 2 * inner * std::sin(pi / sides);
    const Index first = tangent(p, true), last = tangent(q, false);
    const Point a = corner(first, inner, 0), b = corner(last, inner, 0);
    return std::hypot(p[0] - a[0], p[1] - a[1]) + (last + sides - first) % sides * side +
           std::hypot(q[0] - b[0], q[1] - b[1]);
  }
  // The corner that a string from p touches first when it goes around anticlockwise: the side
  // behind it faces away from p. Or the last one of a string that ends at p. A side that p lies on
  // counts as facing it.
  [[nodiscard]] Index tangent(Point p, bool leaving) const {
    for (Index i = 0; i < sides; ++i) {
      const bool before = beyond(i + sides - 1, p) > -rounding, behind = beyond(i, p) > -rounding;
      if (leaving ? before && !behind : !before && behind) return i;
    }
    return 0;
  }
  static constexpr double rounding = 1e-12;
};

/// Distances around a ball about the origin.
inline std::vector<double> around_ball(const std::vector<Point>& points, Point source,
                                       double radius) {
  std::vector<double> d;
  const auto tangent = [&](double to_centre) {
    return std::sqrt(std::max(0., to_centre * to_centre - radius * radius));
  };
  const double s = std::sqrt(dot(source, source));
  for (const Point& p : points) {
    const Point way = p - source;
    const double straight = std::sqrt(dot(way, way)), r = std::sqrt(dot(p, p));
    const double along = straight > 0 ? -dot(source, way) / (straight * straight) : 0;
    const Point near = source + std::clamp(along, 0., 1.) * way;
    if (along <= 0 || along >= 1 || dot(near, near) >= radius * radius) {
      d.push_back(straight);
      continue;
    }
    const Point across = cross(source, p);
    const double arc = std::atan2(std::sqrt(dot(across, across)), dot(source, p)) -
                       std::acos(std::min(1., radius / s)) - std::acos(std::min(1., radius / r));
    d.push_back(tangent(s) + tangent(r) + radius * std::max(0., arc));
  }
  return d;
}

/// A cube of two units a side about the origin, and in it a ball of triangles, 20 n^2 of them. The
/// ball has the area of a round one with radius 1/2: with its vertices on the round one all paths
/// over it were too short.
inline Shape ball_in_cube(Index n) {
  Shape shape = geodesic_sphere(n);
  double area = 0;
  for (const auto& [a, b, c] : shape.faces) {
    const Point normal =
        cross(shape.points[b] - shape.points[a], shape.points[c] - shape.points[a]);
    area += std::sqrt(dot(normal, normal)) / 2;
  }
  const double radius = 0.5 * std::sqrt(4 * pi / area);
  for (Point& p : shape.points) p = radius * p;
  const auto first = static_cast<Index>(shape.points.size());
  for (int i = 0; i < 8; ++i) shape.add({i % 2 * 2. - 1, i / 2 % 2 * 2. - 1, i / 4 * 2. - 1});
  constexpr std::array<std::array<Index, 4>, 6> sides = {
      {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}}};
  for (const auto& [a, b, c, d] : sides) {
    shape.faces.push_back({first + a, first + b, first + c});
    shape.faces.push_back({first + a, first + c, first + d});
  }
  return shape;
}
/// For `tets` tetrahedra around it, facets as large as their faces.
inline Index ball_parts_for(double tets) {
  const double edge = std::cbrt(8.5 * 7.5 / tets);
  return std::max(Index{1}, static_cast<Index>(std::lround(0.5 * 1.15 / edge)));
}

}  // namespace samples
