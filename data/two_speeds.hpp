#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <map>
#include <random>
#include <utility>
#include <vector>

/// A square with one speed below its middle line and another one above: travel times are known in
/// closed form, refracted as Snell's law says, and head waves along the line included.
namespace samples {

struct TwoSpeeds {
  double below = 1, above = 2;

  /// Travel time between two points of the plane; the line is y = 0.
  [[nodiscard]] double time(const std::array<double, 3>& a, const std::array<double, 3>& b) const {
    const double dx = std::abs(b[0] - a[0]), p = std::abs(a[1]), q = std::abs(b[1]);
    const auto speed = [&](double y) { return y < 0 ? below : above; };
    const double fast = std::max(below, above);
    if (a[1] == 0 || b[1] == 0 || (a[1] < 0) == (b[1] < 0)) {
      const double own = a[1] == 0 && b[1] == 0 ? fast : speed(a[1] == 0 ? b[1] : a[1]);
      const double direct = std::hypot(dx, b[1] - a[1]) / own;
      if (own == fast) return direct;
      // Down to the line at the critical angle, along it on the fast side, and up again.
      const double sine = own / fast, cosine = std::sqrt(1 - sine * sine);
      if (dx * cosine < (p + q) * sine) return direct;
      return std::min(direct, dx / fast + (p + q) * cosine / own);
    }
    // Fermat: convex in where it crosses.
    const double v = speed(a[1]), w = speed(b[1]);
    double low = 0, high = dx;
    for (int i = 0; i < 100; ++i) {
      const double x = (low + high) / 2;
      (x / std::hypot(x, p) / v < (dx - x) / std::hypot(dx - x, q) / w ? low : high) = x;
    }
    return std::hypot(low, p) / v + std::hypot(dx - low, q) / w;
  }
};

/// A square of n x n cells, [0, 1] x [-1/2, 1/2] with n even: no edge crosses y = 0, and faces are
/// Delaunay but for that.
struct HalvedSquare {
  std::vector<std::array<double, 3>> points;
  std::vector<std::array<std::uint32_t, 3>> faces;

  /// `shake`: vertices are moved at random by up to so many cells, below 0.5.
  HalvedSquare(std::uint32_t n, double shake, unsigned seed = 1) {
    std::mt19937 random(seed);
    const auto moved = [&] { return shake * (static_cast<double>(random()) / 2147483648.0 - 1); };
    for (std::uint32_t j = 0; j <= n; ++j)
      for (std::uint32_t i = 0; i <= n; ++i) {
        const double x = i + (i > 0 && i < n ? moved() : 0);
        const double y = j + (j > 0 && j < n && 2 * j != n ? moved() : 0);
        points.push_back({x / n, 2 * j == n ? 0 : y / n - 0.5, 0});
      }
    for (std::uint32_t j = 0; j < n; ++j)
      for (std::uint32_t i = 0; i < n; ++i) {
        const std::uint32_t a = j * (n + 1) + i, b = a + 1, c = a + n + 1, d = c + 1;
        faces.push_back({a, b, d});
        faces.push_back({a, d, c});
      }
    if (shake > 0) flip_to_delaunay();
  }

  [[nodiscard]] bool is_above(std::size_t f) const {
    return points[faces[f][0]][1] + points[faces[f][1]][1] + points[faces[f][2]][1] > 0;
  }

  /// The vertex nearest to a place.
  [[nodiscard]] std::uint32_t nearest(double x, double y) const {
    const auto off = [&](const auto& p) { return std::hypot(p[0] - x, p[1] - y); };
    return static_cast<std::uint32_t>(
        std::min_element(points.begin(), points.end(),
                         [&](const auto& a, const auto& b) { return off(a) < off(b); }) -
        points.begin());
  }

 private:
  void flip_to_delaunay() {
    const auto cosine_at = [&](std::uint32_t at, std::uint32_t b, std::uint32_t c) {
      const auto &p = points[at], &q = points[b], &r = points[c];
      const double ux = q[0] - p[0], uy = q[1] - p[1], vx = r[0] - p[0], vy = r[1] - p[1];
      return std::pair{ux * vx + uy * vy, ux * vy - uy * vx};
    };
    for (bool any = true; any;) {
      any = false;
      std::map<std::pair<std::uint32_t, std::uint32_t>, std::pair<std::size_t, std::size_t>> side;
      for (std::size_t f = 0; f < faces.size(); ++f)
        for (std::size_t i = 0; i < 3; ++i) side[{faces[f][i], faces[f][(i + 1) % 3]}] = {f, i};
      std::vector<char> changed(faces.size(), 0);
      for (const auto& [ends, here] : side) {
        const auto [a, b] = ends;
        const auto there = side.find({b, a});
        if (a > b || there == side.end()) continue;
        if (points[a][1] == 0 && points[b][1] == 0) continue;
        const auto [f, i] = here;
        const auto [g, j] = there->second;
        if (changed[f] || changed[g]) continue;
        const std::uint32_t c = faces[f][(i + 2) % 3], d = faces[g][(j + 2) % 3];
        const auto [c1, s1] = cosine_at(c, a, b);
        const auto [c2, s2] = cosine_at(d, b, a);
        if (s1 * c2 + c1 * s2 > -1e-12) continue;  // opposite angles add up to pi at most
        faces[f] = {c, a, d};
        faces[g] = {d, b, c};
        changed[f] = changed[g] = 1;
        any = true;
      }
    }
  }
};

}  // namespace samples
