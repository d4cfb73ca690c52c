#pragma once

#include <array>
#include <cmath>
#include <vector>

#include <plexway/error.hpp>
#include <plexway/tetgen/tetrahedralize.hpp>

#include "data/shapes.hpp"
#include "message_of.hpp"

namespace tetgen_testing {

using plexway::testing::message_of;
using plexway::tetgen::Solid;
using samples::Index;
using samples::Point;
using samples::Shape;

inline double volume(const Solid& solid, std::size_t tet) {
  using namespace samples;
  const auto& [a, b, c, d] = solid.tets[tet];
  const Point p = solid.positions[a];
  return dot(cross(solid.positions[b] - p, solid.positions[c] - p), solid.positions[d] - p) / 6;
}

inline double volume(const Solid& solid) {
  double sum = 0;
  for (std::size_t t = 0; t < solid.tets.size(); ++t) sum += volume(solid, t);
  return sum;
}

/// What a surface encloses, by the divergence theorem.
inline double enclosed(const Shape& surface) {
  double sum = 0;
  for (const auto& [a, b, c] : surface.faces)
    sum +=
        samples::dot(samples::cross(surface.points[a], surface.points[b]), surface.points[c]) / 6;
  return std::abs(sum);
}

/// A cube of 12 triangles, its corners at 0 and `side` in each direction.
inline Shape cube(double side = 1) {
  Shape shape;
  for (int i = 0; i < 8; ++i) shape.add({side * (i & 1), side * (i >> 1 & 1), side * (i >> 2)});
  for (const auto& [a, b, c, d] : std::vector<std::array<Index, 4>>{
           {0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}}) {
    shape.faces.push_back({a, b, c});
    shape.faces.push_back({a, c, d});
  }
  return shape;
}

/// Both shapes, the second one scaled and then moved.
inline Shape together(Shape first, const Shape& second, Point move, double scale = 1) {
  using namespace samples;
  const auto offset = static_cast<Index>(first.points.size());
  for (const Point& p : second.points) first.points.push_back(scale * p + move);
  for (const auto& [a, b, c] : second.faces)
    first.faces.push_back({a + offset, b + offset, c + offset});
  return first;
}

inline Solid fill(const Shape& surface, const plexway::tetgen::TetrahedralizeOptions& options = {},
                  const std::vector<Point>& holes = {}) {
  return plexway::tetgen::tetrahedralize(surface.points, surface.faces, holes, options);
}

}  // namespace tetgen_testing
