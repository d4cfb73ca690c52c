#pragma once

// Clouds sampled from surfaces whose distances are known in closed form.

#include <cstddef>
#include <functional>

#include "shapes.hpp"

namespace samples {

/// Points of a surface, moved along the normal by `noise`, and what is true of the clean surface.
struct SampledCloud {
  std::vector<Point> points;
  std::vector<Point> clean, normal;
  std::vector<std::array<double, 2>> chart;  ///< unrolled; empty for the sphere
  double spacing = 1;                        ///< square root of the area of each point

  /// On the clean surface, where the chart is convex.
  [[nodiscard]] double distance(std::size_t a, std::size_t b) const {
    if (!chart.empty()) return std::hypot(chart[a][0] - chart[b][0], chart[a][1] - chart[b][1]);
    const Point c = cross(clean[a], clean[b]);
    return std::atan2(std::sqrt(dot(c, c)), dot(clean[a], clean[b]));
  }
  [[nodiscard]] std::vector<double> distances_from(std::size_t a) const {
    std::vector<double> d(clean.size());
    for (std::size_t b = 0; b < d.size(); ++b) d[b] = distance(a, b);
    return d;
  }
};

/// About normal, from twelve uniform numbers.
inline double bell(Noise& random) {
  double sum = 0;
  for (int i = 0; i < 12; ++i) sum += random();
  return sum / 2;
}

inline void finish(SampledCloud& cloud, double noise, Noise& random) {
  cloud.points = cloud.clean;
  for (std::size_t i = 0; noise > 0 && i < cloud.points.size(); ++i) {
    const double off = noise * cloud.spacing * bell(random);
    for (std::size_t d = 0; d < 3; ++d) cloud.points[i][d] += off * cloud.normal[i][d];
  }
}

/// A unit sphere. Noise in spacings, as below.
inline SampledCloud sampled_sphere(std::size_t n, double noise = 0, std::uint64_t seed = 1) {
  Noise random(seed);
  SampledCloud cloud;
  cloud.spacing = std::sqrt(4 * pi / static_cast<double>(n));
  for (std::size_t i = 0; i < n; ++i) {
    const double z = random(), t = pi * random(), r = std::sqrt(1 - z * z);
    cloud.clean.push_back({r * std::cos(t), r * std::sin(t), z});
  }
  cloud.normal = cloud.clean;
  finish(cloud, noise, random);
  return cloud;
}

/// A sheet `width` by `height`, bent so that `curve` maps along its width to a plane curve (x, z)
/// and its direction.
inline SampledCloud bent_sheet(std::size_t n, double width, double height, double noise,
                               std::uint64_t seed,
                               const std::function<std::array<double, 4>(double along)>& curve) {
  Noise random(seed);
  SampledCloud cloud;
  cloud.spacing = std::sqrt(width * height / static_cast<double>(n));
  for (std::size_t i = 0; i < n; ++i) {
    const double s = width * (random() + 1) / 2, y = height * (random() + 1) / 2;
    const auto [x, z, dx, dz] = curve(s);
    cloud.chart.push_back({s, y});
    cloud.clean.push_back({x, y, z});
    cloud.normal.push_back({dz, 0, -dx});
  }
  finish(cloud, noise, random);
  return cloud;
}

/// The unit square.
inline SampledCloud sampled_plane(std::size_t n, double noise = 0, std::uint64_t seed = 2) {
  return bent_sheet(n, 1, 1, noise, seed, [](double s) { return std::array{s, 0.0, 1.0, 0.0}; });
}

/// Three quarters of a cylinder of radius 1 and height 3.
inline SampledCloud sampled_cylinder(std::size_t n, double noise = 0, std::uint64_t seed = 3) {
  return bent_sheet(n, 1.5 * pi, 3, noise, seed, [](double s) {
    return std::array{std::cos(s), std::sin(s), -std::sin(s), std::cos(s)};
  });
}

/// The roll r = t, 1.5 pi <= t <= 4.5 pi, 21 high.
inline SampledCloud sampled_swiss(std::size_t n, double noise = 0, std::uint64_t seed = 4) {
  const auto length = [](double t) { return (t * std::hypot(1, t) + std::asinh(t)) / 2; };
  const double first = 1.5 * pi, last = 4.5 * pi;
  return bent_sheet(n, length(last) - length(first), 21, noise, seed, [=](double s) {
    double t = (first + last) / 2;  // by Newton
    for (int i = 0; i < 30; ++i) t -= (length(t) - length(first) - s) / std::hypot(1, t);
    const double dx = std::cos(t) - t * std::sin(t), dz = std::sin(t) + t * std::cos(t);
    const double speed = std::hypot(dx, dz);
    return std::array{t * std::cos(t), t * std::sin(t), dx / speed, dz / speed};
  });
}

}  // namespace samples
