#pragma once

#include <array>
#include <cmath>
#include <vector>

#include <plexway/paths/path_field.hpp>
#include <plexway/source/source.hpp>

#include "data/shapes.hpp"

/// A path on a surface as a source: all of it, or points of it.
namespace bench {

/// Of a path from vertex `to`, where it is traced from, to vertex `from`.
inline plexway::CurveSource curve_of(const plexway::Path& path, plexway::Index from,
                                     plexway::Index to) {
  plexway::CurveSource curve;
  curve.points.push_back(plexway::PointSource::at(to));
  for (std::size_t i = 1; i + 1 < path.points.size(); ++i)
    curve.points.push_back(
        plexway::PointSource::in(path.points[i].simplex, path.points[i].barycentric));
  curve.points.push_back(plexway::PointSource::at(from));
  return curve;
}

/// At equal steps. The piece after a point is in the simplex that the path names there.
inline std::vector<plexway::PointSource> points_along(
    const plexway::Path& path, const std::vector<samples::Point>& positions,
    const std::vector<std::array<plexway::Index, 3>>& faces, std::size_t count) {
  using namespace samples;
  std::vector<plexway::PointSource> points;
  const auto norm = [](const Point& p) { return std::sqrt(dot(p, p)); };
  const double steps = static_cast<double>(count);
  double walked = 0;
  for (std::size_t i = 0; i + 1 < path.points.size(); ++i) {
    const Point p = path.positions[i], step = path.positions[i + 1] - p;
    const double length = norm(step);
    while (points.size() < count) {
      const double t =
          (path.length * (static_cast<double>(points.size()) + 0.5) / steps - walked) / length;
      if (t > 1) break;
      const auto& f = faces[path.points[i].simplex];
      const Point x = p + t * step, &a = positions[f[0]], &b = positions[f[1]],
                  &c = positions[f[2]];
      const auto area = [&](const Point& y, const Point& z) { return norm(cross(y - x, z - x)); };
      const double u = area(b, c), v = area(c, a), w = area(a, b), sum = u + v + w;
      points.push_back(
          plexway::PointSource::in(path.points[i].simplex, {u / sum, v / sum, w / sum}));
    }
    walked += length;
  }
  return points;
}

}  // namespace bench
