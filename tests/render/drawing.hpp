#pragma once

#include <catch2/catch.hpp>
#include <cmath>
#include <limits>
#include <optional>

#include <plexway/error.hpp>
#include <plexway/render/picture.hpp>

/// Shapes to draw, and ways to look at what was drawn.
namespace render_testing {

using namespace plexway::render;
using Triangle = std::array<std::uint32_t, 3>;
using Tet = std::array<std::uint32_t, 4>;

/// The picture, or nothing where this machine has no driver: then the test returns.
inline std::optional<Image> drawn(const Scene& scene, const PictureOptions& options) {
  try {
    return picture(scene, options);
  } catch (const plexway::NotBuiltError& error) {
    WARN("skipped, nothing to draw with: " << error.what());
    return std::nullopt;
  }
}

/// Vertices with triangles or tetrahedra.
struct Shape {
  std::vector<Point> positions;
  std::vector<Triangle> triangles;
  std::vector<Tet> tets;
  std::vector<double> value;

  template <class Function>
  Shape& with(Function f) {
    value.clear();
    for (const Point& p : positions) value.push_back(f(p));
    return *this;
  }
  [[nodiscard]] Part part() const {
    Part p;
    p.positions = positions;
    p.triangles = triangles;
    p.tets = tets;
    p.value = value;
    return p;
  }
};

/// [0, 1]^2 in the plane z = 0, n x n squares.
inline Shape square(std::uint32_t n) {
  Shape s;
  for (std::uint32_t y = 0; y <= n; ++y)
    for (std::uint32_t x = 0; x <= n; ++x) s.positions.push_back({double(x) / n, double(y) / n, 0});
  for (std::uint32_t y = 0; y < n; ++y)
    for (std::uint32_t x = 0; x < n; ++x) {
      const std::uint32_t v = y * (n + 1) + x;
      s.triangles.push_back({v, v + 1, v + n + 2});
      s.triangles.push_back({v, v + n + 2, v + n + 1});
    }
  return s;
}

/// [0, 1]^3, n x n x n cubes of six tetrahedra around a diagonal.
inline Shape cube(std::uint32_t n) {
  Shape s;
  const auto at = [n](std::uint32_t x, std::uint32_t y, std::uint32_t z) {
    return (z * (n + 1) + y) * (n + 1) + x;
  };
  for (std::uint32_t z = 0; z <= n; ++z)
    for (std::uint32_t y = 0; y <= n; ++y)
      for (std::uint32_t x = 0; x <= n; ++x)
        s.positions.push_back({double(x) / n, double(y) / n, double(z) / n});
  constexpr std::array<std::array<std::size_t, 3>, 6> orders = {
      {{0, 1, 2}, {0, 2, 1}, {1, 0, 2}, {1, 2, 0}, {2, 0, 1}, {2, 1, 0}}};
  for (std::uint32_t z = 0; z < n; ++z)
    for (std::uint32_t y = 0; y < n; ++y)
      for (std::uint32_t x = 0; x < n; ++x)
        for (const auto& order : orders) {
          std::array<std::uint32_t, 3> corner = {x, y, z};
          Tet t{};
          t[0] = at(x, y, z);
          for (std::size_t k = 0; k < 3; ++k) {
            ++corner[order[k]];
            t[k + 1] = at(corner[0], corner[1], corner[2]);
          }
          s.tets.push_back(t);
        }
  return s;
}

/// Around the z axis, radii 1 and 0.4.
inline Shape torus(std::uint32_t n, std::uint32_t m) {
  Shape s;
  constexpr double turn = 6.28318530717958647692;
  for (std::uint32_t i = 0; i < n; ++i)
    for (std::uint32_t j = 0; j < m; ++j) {
      const double u = turn * i / n, v = turn * j / m, r = 1 + 0.4 * std::cos(v);
      s.positions.push_back({r * std::cos(u), r * std::sin(u), 0.4 * std::sin(v)});
      const std::uint32_t a = i * m + j, b = (i + 1) % n * m + j, c = (i + 1) % n * m + (j + 1) % m,
                          d = i * m + (j + 1) % m;
      s.triangles.push_back({a, b, c});
      s.triangles.push_back({a, c, d});
    }
  return s;
}

/// So many points spread over the unit sphere, along a spiral.
inline std::vector<Point> ball_points(std::size_t count) {
  std::vector<Point> points;
  for (std::size_t k = 0; k < count; ++k) {
    const double z = 1 - (2 * double(k) + 1) / double(count);
    const double r = std::sqrt(1 - z * z), angle = 2.39996322972865332 * double(k);
    points.push_back({r * std::cos(angle), r * std::sin(angle), z});
  }
  return points;
}

/// The smallest rectangle of pixels that holds all that `counts`.
struct Extent {
  double left = 1e9, right = -1, top = 1e9, bottom = -1;

  /// A place in it: 0, 0 is lower left, 1, 1 upper right.
  [[nodiscard]] std::array<double, 2> at(double u, double v) const {
    return {left + u * (right - left), bottom + v * (top - bottom)};
  }
};
template <class Counts>
Extent extent(const Image& image, Counts counts) {
  Extent e;
  for (std::size_t y = 0; y < image.height; ++y)
    for (std::size_t x = 0; x < image.width; ++x) {
      if (!counts(image.at(x, y))) continue;
      e.left = std::min(e.left, double(x)), e.right = std::max(e.right, double(x) + 1);
      e.top = std::min(e.top, double(y)), e.bottom = std::max(e.bottom, double(y) + 1);
    }
  return e;
}
inline bool is_drawn(const std::array<std::uint8_t, 4>& p) {
  return p[3] > 127 && p[0] + p[1] + p[2] < 740;
}
inline const std::array<std::uint8_t, 4>& pixel(const Image& image,
                                                const std::array<double, 2>& at) {
  return image.at(static_cast<std::size_t>(at[0]), static_cast<std::size_t>(at[1]));
}

/// Small, plain and seen without perspective.
inline PictureOptions plainly(double azimuth, double elevation) {
  PictureOptions o;
  o.width = 240, o.height = 240;
  o.view = View{azimuth, elevation};
  o.orthographic = true;
  o.legend = false;
  o.isolines = 0;
  return o;
}

}  // namespace render_testing
