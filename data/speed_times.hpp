#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>
#include <vector>

/// Times of shortest paths where pieces have speeds of their own: Snell's law and head waves.
namespace samples {

using Position = std::array<double, 3>;
constexpr double never = std::numeric_limits<double>::infinity();

inline double distance(const Position& a, const Position& b) {
  return std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]);
}

/// Times where slowness is 1 and a line or plane has speed c: r and rho are the distances of the
/// two ends from it, x that of their feet. `direct`: without it.
inline double along_fast(double r, double rho, double x, double c, double direct) {
  if (c <= 1 || x < (r + rho) / std::sqrt(c * c - 1)) return direct;
  return std::min(direct, x / c + (r + rho) * std::sqrt(1 - 1 / (c * c)));
}

/// From height h over a line at speed v to depth d under it at speed w.
inline double refracted(double h, double d, double x, double v, double w) {
  double low = 0, high = x;
  const auto way = [&](double s) { return std::hypot(s, h) / v + std::hypot(x - s, d) / w; };
  for (int i = 0; i < 100; ++i) {
    const double a = low + (high - low) / 3, b = high - (high - low) / 3;
    (way(a) < way(b) ? high : low) = way(a) < way(b) ? b : a;
  }
  return way((low + high) / 2);
}

/// In the plane of the two places and the middle: onto the circle, along it, and off it.
inline double by_the_skin(const Position& p, const Position& q, double c) {
  const double direct = distance(p, q);
  if (c <= 1) return direct;
  const double r = distance(p, {0, 0, 0}), s = distance(q, {0, 0, 0});
  const double cosine = r * s > 0 ? (p[0] * q[0] + p[1] * q[1] + p[2] * q[2]) / (r * s) : 1;
  const double angle = std::acos(std::clamp(cosine, -1., 1.));
  const auto way = [&](double on, double off) {
    return std::sqrt(std::max(0., 1 + r * r - 2 * r * std::cos(on))) + (off - on) / c +
           std::sqrt(std::max(0., 1 + s * s - 2 * s * std::cos(angle - off)));
  };
  double best = never, on = 0, off = angle, step = angle / 24;
  for (int i = 0; i <= 24; ++i)
    for (int j = i; j <= 24; ++j)
      if (const double d = way(i * angle / 24, j * angle / 24); d < best)
        best = d, on = i * angle / 24, off = j * angle / 24;
  for (int round = 0; round < 200 && step > 1e-9; ++round) {
    const double a = on, b = off;
    for (const double x : {a - step, a, a + step})
      for (const double y : {b - step, b, b + step})
        if (x >= 0 && x <= y && y <= angle && way(x, y) < best) best = way(x, y), on = x, off = y;
    if (on == a && off == b) step /= 2;
  }
  return std::min(direct, best);
}

/// Speed v[k] between z[k - 1] and z[k].
struct Layers {
  std::vector<double> z, v;

  [[nodiscard]] double low(std::size_t k) const { return k > 0 ? z[k - 1] : -never; }
  [[nodiscard]] double high(std::size_t k) const { return k < z.size() ? z[k] : never; }

  /// From height a to b, x apart in the planes: each layer between is passed once. Snell's law
  /// leaves one unknown.
  [[nodiscard]] double through(double x, double a, double b) const {
    if (a > b) std::swap(a, b);
    std::vector<double> height, speed;
    double fastest = 0, along = never;
    for (std::size_t k = 0; k < v.size(); ++k) {
      if (a >= low(k) && b <= high(k)) along = std::min(along, std::hypot(x, b - a) / v[k]);
      const double h = std::min(b, high(k)) - std::max(a, low(k));
      if (!(h > 0)) continue;
      height.push_back(h);
      speed.push_back(v[k]);
      fastest = std::max(fastest, v[k]);
    }
    if (height.size() < 2) return along;
    const auto reach = [&](double slowness) {
      double sum = 0;
      for (std::size_t i = 0; i < height.size(); ++i) {
        const double sine = slowness * speed[i];
        sum += height[i] * sine / std::sqrt(std::max(1e-300, 1 - sine * sine));
      }
      return sum;
    };
    double least = 0, most = 1 / fastest;
    for (int i = 0; i < 200; ++i) {
      const double middle = (least + most) / 2;
      (reach(middle) < x ? least : most) = middle;
    }
    double time = least * x;
    for (std::size_t i = 0; i < height.size(); ++i) {
      const double sine = least * speed[i];
      time += height[i] / speed[i] * std::sqrt(std::max(0., 1 - sine * sine));
    }
    return time;
  }

  /// The same by way of plane p, along which it runs at the speed of layer k beside it.
  [[nodiscard]] double along(std::size_t p, std::size_t k, double x, double a, double b) const {
    double time = x / v[k], least = 0;
    for (const double end : {a, b})
      for (std::size_t i = 0; i < v.size(); ++i) {
        const double h =
            std::min(std::max(end, z[p]), high(i)) - std::max(std::min(end, z[p]), low(i));
        if (!(h > 0)) continue;
        const double sine = v[i] / v[k];
        if (sine >= 1) return never;
        const double cosine = std::sqrt(1 - sine * sine);
        time += h / v[i] * cosine;
        least += h * sine / cosine;
      }
    return x < least ? never : time;
  }

  /// The least of these.
  [[nodiscard]] double time(const Position& p, const Position& q) const {
    const double x = std::hypot(p[0] - q[0], p[1] - q[1]);
    double best = through(x, p[2], q[2]);
    for (std::size_t i = 0; i < z.size(); ++i)
      for (const std::size_t k : {i, i + 1}) best = std::min(best, along(i, k, x, p[2], q[2]));
    return best;
  }
};

}  // namespace samples
