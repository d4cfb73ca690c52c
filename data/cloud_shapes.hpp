#pragma once

// Clouds of points at random on surfaces whose geodesics are known, and the exact distances. Point
// 0 is meant as the source. Used by tests and benchmarks.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "shapes.hpp"

namespace samples {

struct Cloud {
  std::string name;
  std::vector<Point> points;
  /// Exact distance between two points of the surface, by number.
  std::function<double(std::size_t, std::size_t)> distance;
  double area = 0;

  [[nodiscard]] double spacing() const {
    return std::sqrt(area / static_cast<double>(points.size()));
  }
};

/// Numbers in [0, 1).
class Uniform {
 public:
  explicit Uniform(std::uint64_t seed) : noise_(seed) {}
  double operator()() { return (noise_() + 1) / 2; }
  double operator()(double low, double high) { return low + (high - low) * (*this)(); }

 private:
  Noise noise_;
};

inline double between(const Point& a, const Point& b) {
  return std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]);
}

/// The unit square.
inline Cloud plane_cloud(std::size_t n, std::uint64_t seed = 1) {
  Uniform u(seed);
  std::vector<Point> points(n);
  for (Point& p : points) p[0] = u(), p[1] = u(), p[2] = 0;
  if (n > 0) points[0] = {0.31, 0.42, 0};
  return {"plane", points,
          [points](std::size_t i, std::size_t j) { return between(points[i], points[j]); }, 1};
}

/// The unit sphere; `noise` moves points along the radius, and distances stay those of the sphere.
inline Cloud sphere_cloud(std::size_t n, std::uint64_t seed = 1, double noise = 0) {
  Uniform u(seed);
  std::vector<Point> points(n), clean;
  for (Point& p : points) {
    const double z = u(-1, 1), a = u(0, 2 * std::numbers::pi), r = std::sqrt(1 - z * z);
    p = {r * std::cos(a), r * std::sin(a), z};
  }
  clean = points;
  for (Point& p : points) {
    // Nearly normal: the sum of twelve.
    double sum = -6;
    for (int i = 0; i < 12 && noise > 0; ++i) sum += u();
    for (double& x : p) x *= noise > 0 ? 1 + noise * sum : 1;
  }
  return {noise > 0 ? "noisy sphere" : "sphere", points,
          [clean](std::size_t i, std::size_t j) {
            return 2 * std::asin(std::min(between(clean[i], clean[j]) / 2, 1.0));
          },
          4 * std::numbers::pi};
}

/// A flat w by h sheet bent so that arc length s lies at the place `bend(s)` of a plane curve.
inline Cloud rolled_cloud(std::string name, std::size_t n, double w, double h,
                          const std::function<std::array<double, 2>(double)>& bend,
                          std::uint64_t seed) {
  Uniform u(seed);
  std::vector<Point> points(n);
  std::vector<std::array<double, 2>> flat(n);
  for (std::size_t i = 0; i < n; ++i) {
    flat[i] = {w * u(), h * u()};
    if (i == 0) flat[i] = {0.4 * w, 0.45 * h};
    const auto [x, z] = bend(flat[i][0]);
    points[i] = {x, flat[i][1], z};
  }
  return {std::move(name), points,
          [flat](std::size_t i, std::size_t j) {
            return std::hypot(flat[i][0] - flat[j][0], flat[i][1] - flat[j][1]);
          },
          w * h};
}

/// Arc length of the spiral (t cos t, t sin t) from 0 to t.
inline double spiral_length(double t) { return (t * std::sqrt(1 + t * t) + std::asinh(t)) / 2; }

/// The swiss roll: a spiral of one and a half turns from t = 3 pi / 2, 20 wide.
inline Cloud swiss_cloud(std::size_t n, std::uint64_t seed = 1) {
  const double from = 1.5 * std::numbers::pi, to = 4.5 * std::numbers::pi;
  const auto bend = [from, to](double s) -> std::array<double, 2> {
    const double goal = spiral_length(from) + s;
    double low = from, high = to;
    for (int i = 0; i < 60; ++i) {
      const double middle = (low + high) / 2;
      (spiral_length(middle) < goal ? low : high) = middle;
    }
    return {low * std::cos(low), low * std::sin(low)};
  };
  return rolled_cloud("swiss roll", n, spiral_length(to) - spiral_length(from), 20, bend, seed);
}

/// The side of a cylinder of radius 1 and height 2, cut nowhere.
inline Cloud cylinder_cloud(std::size_t n, std::uint64_t seed = 1) {
  const double round = 2 * std::numbers::pi;
  Cloud cloud = rolled_cloud(
      "cylinder", n, round, 2,
      [](double s) -> std::array<double, 2> {
        return {std::cos(s), std::sin(s)};
      },
      seed);
  const std::vector<Point> points = cloud.points;
  cloud.distance = [points](std::size_t i, std::size_t j) {
    const double a = std::hypot(points[i][0] - points[j][0], points[i][2] - points[j][2]) / 2;
    return std::hypot(2 * std::asin(std::min(a, 1.0)), points[i][1] - points[j][1]);
  };
  return cloud;
}

/// Two flat sheets `gap` apart, w by 1 each, that half a cylinder joins at x = w: a hairpin.
inline Cloud hairpin_cloud(std::size_t n, double w, double gap, std::uint64_t seed = 1) {
  const double r = gap / 2, turn = std::numbers::pi * r;
  return rolled_cloud(
      "hairpin", n, 2 * w + turn, 1,
      [=](double s) -> std::array<double, 2> {
        if (s < w) return {s, 0};
        if (s > w + turn) return {2 * w + turn - s, gap};
        const double a = (s - w) / r;
        return {w + r * std::sin(a), r - r * std::cos(a)};
      },
      seed);
}

/// The unit square without the block from (0.4, 0) to (0.6, 0.6): paths bend at its corners.
inline Cloud wall_cloud(std::size_t n, std::uint64_t seed = 1) {
  Uniform u(seed);
  std::vector<Point> points(n);
  const auto in_block = [](double x, double y) { return x > 0.4 && x < 0.6 && y < 0.6; };
  for (Point& p : points) {
    p = {u(), u(), 0};
    while (in_block(p[0], p[1])) p = {u(), u(), 0};
  }
  if (n > 0) points[0] = {0.15, 0.2, 0};
  const auto distance = [points](std::size_t i, std::size_t j) {
    // From left to right of the block, or from the right to above it: seen or around a corner.
    Point a = points[i], b = points[j];
    if (a[0] > b[0]) std::swap(a, b);
    const Point left = {0.4, 0.6, 0}, right = {0.6, 0.6, 0};
    const auto height_at = [&](const Point& p, const Point& q, double x) {
      return p[1] + (q[1] - p[1]) * (x - p[0]) / (q[0] - p[0]);
    };
    const auto below = [&](const Point& p, const Point& q, double x) {
      return p[0] < x && q[0] > x && height_at(p, q, x) < 0.6;
    };
    const bool at_left = below(a, b, 0.4), at_right = below(a, b, 0.6);
    if (!at_left && !at_right) return between(a, b);
    double best = std::numeric_limits<double>::infinity();
    if (!below(left, b, 0.6)) best = std::min(best, between(a, left) + between(left, b));
    if (!below(a, right, 0.4)) best = std::min(best, between(a, right) + between(right, b));
    return std::min(best, between(a, left) + between(left, right) + between(right, b));
  };
  return {"wall", points, distance, 0.88};
}

}  // namespace samples
