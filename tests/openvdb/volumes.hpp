#pragma once

#include <algorithm>
#include <array>
#include <catch2/catch.hpp>
#include <cmath>
#include <map>
#include <random>
#include <utility>
#include <vector>

#include <plexway/error.hpp>
#include <plexway/openvdb/level_set.hpp>
#include <plexway/openvdb/solid.hpp>

#include "data/shapes.hpp"
#include "io/io_testing.hpp"

namespace volume_testing {

using io_testing::bytes_of;
using io_testing::Folder;
using io_testing::message_of;
using plexway::Index;
using plexway::openvdb::level_set_of;
using plexway::openvdb::LevelSet;
using samples::Point;
using samples::Shape;
using namespace samples;

inline LevelSet ball(double radius, double voxel, Point middle = {0, 0, 0}) {
  const double r = radius + 4 * voxel;
  return level_set_of(
      [&](const Point& p) { return std::sqrt(dot(p - middle, p - middle)) - radius; },
      middle - Point{r, r, r}, middle + Point{r, r, r}, voxel);
}

/// One side of a gyroid of period 1, thickened, in a cube of `side`; about a distance near its
/// surface.
inline LevelSet gyroid(double side, double voxel) {
  const auto function = [&](const Point& p) {
    const double k = 2 * pi;
    const double g = std::sin(k * p[0]) * std::cos(k * p[1]) +
                     std::sin(k * p[1]) * std::cos(k * p[2]) +
                     std::sin(k * p[2]) * std::cos(k * p[0]);
    const double box = std::max({std::abs(p[0] - side / 2), std::abs(p[1] - side / 2),
                                 std::abs(p[2] - side / 2)}) -
                       side / 2;
    return std::max((g - 0.2) / (1.5 * k), box);
  };
  const double r = 4 * voxel;
  return level_set_of(function, {-r, -r, -r}, {side + r, side + r, side + r}, voxel);
}

template <class Solid>
double volume(const Solid& solid) {
  double sum = 0;
  for (const auto& [a, b, c, d] : solid.tets) {
    const Point p = solid.positions[a];
    const double six =
        dot(cross(solid.positions[b] - p, solid.positions[c] - p), solid.positions[d] - p);
    CHECK(six > 0);
    sum += six / 6;
  }
  return sum;
}

template <class Surface>
double enclosed(const Surface& surface) {
  double sum = 0;
  for (const auto& [a, b, c] : surface.triangles)
    sum += dot(cross(surface.positions[a], surface.positions[b]), surface.positions[c]) / 6;
  return sum;
}

/// The smallest and the largest dihedral angle, in degrees.
template <class Solid>
std::pair<double, double> dihedral_angles(const Solid& solid) {
  std::pair<double, double> found = {180, 0};
  for (const auto& tet : solid.tets) {
    std::array<Point, 4> normal;
    constexpr std::array<std::array<std::size_t, 3>, 4> face = {
        {{1, 2, 3}, {0, 3, 2}, {0, 1, 3}, {0, 2, 1}}};
    for (std::size_t i = 0; i < 4; ++i) {
      const Point& o = solid.positions[tet[face[i][0]]];
      normal[i] =
          unit(cross(solid.positions[tet[face[i][1]]] - o, solid.positions[tet[face[i][2]]] - o));
    }
    for (std::size_t i = 0; i < 4; ++i)
      for (std::size_t j = i + 1; j < 4; ++j) {
        const double between = std::acos(std::clamp(dot(normal[i], normal[j]), -1.0, 1.0));
        const double angle = 180 - between * 180 / pi;
        found = {std::min(found.first, angle), std::max(found.second, angle)};
      }
  }
  return found;
}

/// Edges that have not exactly two triangles, one each way.
template <class Surface>
std::size_t unpaired_edges(const Surface& surface) {
  std::map<std::pair<Index, Index>, int> balance;
  for (const auto& t : surface.triangles)
    for (std::size_t i = 0; i < 3; ++i) {
      const Index a = t[i], b = t[(i + 1) % 3];
      balance[std::minmax(a, b)] += a < b ? 1 : -1;
    }
  std::size_t odd = 0;
  for (const auto& [edge, sum] : balance) odd += sum != 0;
  return odd;
}

/// Faces of one tetrahedron only.
template <class Solid>
std::vector<std::array<Index, 3>> boundary(const Solid& solid) {
  std::map<std::array<Index, 3>, int> count;
  for (const auto& tet : solid.tets)
    for (std::size_t i = 0; i < 4; ++i) {
      std::array<Index, 3> face = {tet[(i + 1) % 4], tet[(i + 2) % 4], tet[(i + 3) % 4]};
      std::sort(face.begin(), face.end());
      ++count[face];
    }
  std::vector<std::array<Index, 3>> faces;
  for (const auto& [face, n] : count) {
    REQUIRE(n <= 2);
    if (n == 1) faces.push_back(face);
  }
  return faces;
}

}  // namespace volume_testing
