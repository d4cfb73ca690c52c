#pragma once

// The samples that are points alone, as a scanner gives them.

#include <limits>

#include "shapes.hpp"

namespace samples {

/// A rolled-up sheet of paper, one turn and a half, 2400 points: neighbouring layers are 0.35
/// apart, the points 0.05. The sheet is r = turn / 18 around the z axis, from turn 2 pi to 5 pi;
/// unrolled it is flat, so distances are known.
inline Shape roll() {
  constexpr double height = 1.2, pitch = 1.0 / 18, first = 2 * pi, last = 5 * pi;
  const auto along = [&](double turn) {  // length of the spiral from its centre
    return pitch / 2 * (turn * std::sqrt(1 + turn * turn) + std::asinh(turn));
  };
  constexpr Index rows = 24, columns = 100;
  const double from = along(first), step = (along(last) - from) / (columns - 1);
  Noise noise(17);
  Shape shape;
  for (Index c = 0; c < columns; ++c) {
    for (Index r = 0; r < rows; ++r) {
      const bool rim = c == 0 || c + 1 == columns;
      const double s = from + step * (c + (rim ? 0 : 0.35 * noise()));
      const bool edge = r == 0 || r + 1 == rows;
      const double z = height * (r + (edge ? 0 : 0.35 * noise())) / (rows - 1);
      double turn = std::sqrt(2 * s / pitch);
      for (int i = 0; i < 8; ++i) turn -= (along(turn) - s) / (pitch * std::sqrt(1 + turn * turn));
      shape.points.push_back({pitch * turn * std::cos(turn), pitch * turn * std::sin(turn), z});
    }
  }
  return shape;
}

/// A unit sphere as a depth camera sees it that looks down from (0, 0, 3): 64 x 48 rays, a point
/// for each that meets the sphere not too slantingly, not a number for the others.
inline Shape ball_scan() {
  constexpr Index width = 64, height = 48;
  constexpr double nothing = std::numeric_limits<double>::quiet_NaN();
  Shape shape;
  for (Index row = 0; row < height; ++row) {
    for (Index column = 0; column < width; ++column) {
      const Point ray =
          unit({(column - (width - 1) / 2.0) / 72, ((height - 1) / 2.0 - row) / 72, -1});
      // |(0, 0, 3) + t ray| = 1
      const double half = 3 * ray[2], root = half * half - 8;
      const Point hit = root < 0 ? Point{} : Point{0, 0, 3} + (-half - std::sqrt(root)) * ray;
      const bool seen = root >= 0 && -dot(hit, ray) > 0.35;
      shape.points.push_back(seen ? hit : Point{nothing, nothing, nothing});
    }
  }
  return shape;
}

}  // namespace samples
