#pragma once

// Ways to make a surface: convex hulls (and Delaunay triangulations by them), tubes, surfaces of
// revolution, level sets, extruded outlines, voxels. Only the standard library, as in shapes.hpp.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <functional>
#include <map>
#include <set>
#include <utility>
#include <vector>

#include "shapes.hpp"

namespace samples {

/// The convex hull of points in general position, one after the other: quadratic, so for thousands.
inline std::vector<std::array<Index, 3>> convex_hull(const std::vector<Point>& points) {
  struct Face {
    std::array<Index, 3> corner;
    Point normal;
    double offset;
  };
  std::vector<Face> faces;
  const auto add = [&](Index a, Index b, Index c) {
    const Point n = cross(points[b] - points[a], points[c] - points[a]);
    faces.push_back({{a, b, c}, n, dot(n, points[a])});
  };
  const Point e = points[1] - points[0];
  const bool left = dot(cross(e, points[2] - points[0]), points[3] - points[0]) < 0;
  const Index b = left ? 1 : 2, c = left ? 2 : 1;
  add(0, b, c), add(0, 3, b), add(b, 3, c), add(c, 3, 0);
  for (Index p = 4; p < points.size(); ++p) {
    std::set<std::pair<Index, Index>> rim;  // edges of what p sees, those inside taken out
    std::vector<Face> kept;
    for (const Face& f : faces) {
      if (dot(f.normal, points[p]) <= f.offset) {
        kept.push_back(f);
        continue;
      }
      for (std::size_t i = 0; i < 3; ++i) {
        const Index from = f.corner[i], to = f.corner[(i + 1) % 3];
        if (rim.erase({to, from}) == 0) rim.insert({from, to});
      }
    }
    if (rim.empty()) continue;
    faces = std::move(kept);
    for (const auto& [from, to] : rim) add(from, to, p);
  }
  std::vector<std::array<Index, 3>> corners;
  for (const Face& f : faces) corners.push_back(f.corner);
  return corners;
}

/// The Delaunay triangulation of points by their x and y: the lower hull on a paraboloid. Triangles
/// that are all but flat, as the hull of the plane has them, are left out.
inline Shape delaunay(std::vector<Point> flat) {
  std::vector<Point> lifted;
  for (const Point& p : flat) lifted.push_back({p[0], p[1], p[0] * p[0] + p[1] * p[1]});
  Shape shape;
  shape.points = std::move(flat);
  for (const auto& [a, b, c] : convex_hull(lifted)) {
    const Point n = cross(lifted[b] - lifted[a], lifted[c] - lifted[a]);
    if (n[2] < 0 && -n[2] > 0.05 * std::sqrt(dot(n, n))) shape.faces.push_back({a, c, b});
  }
  return shape;
}

/// About `count` points in the square [0, 1]^2, none nearer to another than a spacing that may
/// change from place to place; and points along the rim.
inline std::vector<Point> scattered(std::size_t count, std::uint64_t seed,
                                    const std::function<double(Point)>& spacing) {
  Noise noise(seed);
  std::vector<Point> points;
  const auto clear = [&](const Point& p, double gap) {
    return std::none_of(points.begin(), points.end(), [&](const Point& q) {
      const Point d = p - q;
      return dot(d, d) < gap * gap;
    });
  };
  for (std::size_t tries = 0; tries < 60 * count && points.size() < count; ++tries) {
    Point p = {(noise() + 1) / 2, (noise() + 1) / 2, 0};
    const double gap = spacing(p);
    if (tries % 8 == 0) {  // on the rim, bent outward a little so that the hull has these corners
      const double bow = 0.02 * p[0] * (1 - p[0]);
      p = tries % 32 == 0    ? Point{p[0], -bow, 0}
          : tries % 32 == 8  ? Point{p[0], 1 + bow, 0}
          : tries % 32 == 16 ? Point{-bow, p[0], 0}
                             : Point{1 + bow, p[0], 0};
    }
    if (clear(p, gap)) points.push_back(p);
  }
  return points;
}

/// How a grid's cells are cut.
enum class Cut { shorter, one_way, by_chance };

/// A grid of nu x nv cells, closed in either direction or not; point(u, v) with u, v in [0, 1].
inline Shape grid(Index nu, Index nv, bool closed_u, bool closed_v, Cut cut,
                  const std::function<Point(double, double)>& point) {
  Shape shape;
  Noise noise(5);
  const Index rows = closed_u ? nu : nu + 1, columns = closed_v ? nv : nv + 1;
  for (Index i = 0; i < rows; ++i)
    for (Index j = 0; j < columns; ++j)
      shape.add(point(static_cast<double>(i) / nu, static_cast<double>(j) / nv));
  for (Index i = 0; i < nu; ++i)
    for (Index j = 0; j < nv; ++j) {
      const auto at = [&](Index k, Index l) { return k % rows * columns + l % columns; };
      const Index a = at(i, j), b = at(i + 1, j), c = at(i + 1, j + 1), d = at(i, j + 1);
      if (cut == Cut::shorter) {
        add_quad(shape, a, b, c, d);
      } else if (cut == Cut::one_way || noise() < 0) {
        shape.faces.push_back({a, b, c});
        shape.faces.push_back({a, c, d});
      } else {
        shape.faces.push_back({a, b, d});
        shape.faces.push_back({b, c, d});
      }
    }
  return shape;
}

/// A profile (radius, height) turned about the z axis. Where the radius is 0 there is one vertex.
inline Shape revolution(const std::vector<std::array<double, 2>>& profile, Index sides) {
  Shape shape;
  std::vector<std::vector<Index>> rings;
  for (const auto& [r, z] : profile) {
    std::vector<Index> ring;
    for (Index j = 0; j < sides; ++j) {
      const double a = 2 * pi * j / sides;
      if (r > 0 || j == 0)
        ring.push_back(shape.add({r * std::cos(a), r * std::sin(a), z}));
      else
        ring.push_back(ring[0]);
    }
    rings.push_back(std::move(ring));
  }
  for (std::size_t i = 0; i + 1 < rings.size(); ++i)
    for (Index j = 0; j < sides; ++j) {
      const Index k = (j + 1) % sides;
      const Index a = rings[i][j], b = rings[i][k], c = rings[i + 1][k], d = rings[i + 1][j];
      if (a == b)
        shape.faces.push_back({a, c, d});
      else if (c == d)
        shape.faces.push_back({a, b, c});
      else
        add_quad(shape, a, b, c, d);
    }
  return shape;
}

/// A tube around a curve, t from 0 to 1, open or closed. The frame is carried along without twist.
inline Shape tube(Index rings, Index sides, bool closed, const std::function<Point(double)>& centre,
                  const std::function<double(double)>& radius) {
  const auto along = [&](double t) { return unit(centre(t + 1e-5) - centre(t - 1e-5)); };
  const auto square_to = [](Point normal, Point t) { return unit(normal - dot(normal, t) * t); };
  Point normal = square_to({0.1, 0.2, 1}, along(0));
  const Point begin = normal;
  std::vector<Point> frame;
  for (Index i = 0; i <= rings; ++i) {
    normal = square_to(normal, along(static_cast<double>(i) / rings));
    frame.push_back(normal);
  }
  const Point t0 = along(0);
  const double missing = closed ? std::atan2(dot(cross(normal, begin), t0), dot(normal, begin)) : 0;
  Index at = 0;
  const auto row = [&](double u, double v) {
    const Index i = at++ / sides;
    const Point t = along(u), n = frame[i], b = cross(t, n);
    const double a = 2 * pi * v + missing * u, r = radius(u);
    return centre(u) + (r * std::cos(a)) * n + (r * std::sin(a)) * b;
  };
  return grid(rings, sides, closed, true, Cut::shorter, row);
}

/// Where f = 0 in the box [lo, hi]^3, by marching tetrahedra on n^3 cubes: slivers included. Where
/// the surface meets the box it has a boundary.
inline Shape level_set(Index n, double lo, double hi, const std::function<double(Point)>& f) {
  const Index m = n + 1;
  const auto place = [&](Index v) {
    const double step = (hi - lo) / n;
    return Point{lo + step * (v % m), lo + step * (v / m % m), lo + step * (v / m / m)};
  };
  std::vector<double> value;
  for (Index v = 0; v < m * m * m; ++v) value.push_back(f(place(v)));
  Shape shape;
  std::map<std::pair<Index, Index>, Index> cuts;
  const auto cut = [&](Index a, Index b) {
    const auto [low, high] = std::minmax(a, b);
    const auto [found, fresh] = cuts.try_emplace({low, high}, 0);
    if (fresh) {
      double t = value[low] / (value[low] - value[high]);
      t = std::clamp(t, 0.05, 0.95);  // no edge of length 0
      found->second = shape.add((1 - t) * place(low) + t * place(high));
    }
    return found->second;
  };
  // Turned so that its normal points to where f is positive.
  const auto face = [&](Index a, Index b, Index c, Point out) {
    const Point& p = shape.points[a];
    const Point normal = cross(shape.points[b] - p, shape.points[c] - p);
    if (dot(normal, out) < 0) std::swap(b, c);
    shape.faces.push_back({a, b, c});
  };
  constexpr int axes[6][3] = {{0, 1, 2}, {0, 2, 1}, {1, 0, 2}, {1, 2, 0}, {2, 0, 1}, {2, 1, 0}};
  const Index stride[3] = {1, m, m * m};
  for (Index z = 0; z < n; ++z)
    for (Index y = 0; y < n; ++y)
      for (Index x = 0; x < n; ++x)
        for (const auto& order : axes) {
          std::array<Index, 4> v = {(z * m + y) * m + x, 0, 0, 0};
          for (std::size_t k = 0; k < 3; ++k) v[k + 1] = v[k] + stride[order[k]];
          std::vector<Index> in, out;
          for (const Index w : v) (value[w] < 0 ? in : out).push_back(w);
          if (in.empty() || out.empty()) continue;
          Point way = {0, 0, 0};
          for (const Index w : out) way = way + (1.0 / static_cast<double>(out.size())) * place(w);
          for (const Index w : in) way = way - (1.0 / static_cast<double>(in.size())) * place(w);
          if (in.size() == 2) {
            const Index a = cut(in[0], out[0]), b = cut(in[0], out[1]), c = cut(in[1], out[1]),
                        d = cut(in[1], out[0]);
            face(a, b, c, way), face(a, c, d, way);
          } else {
            const Index one = in.size() == 1 ? in[0] : out[0];
            const auto& three = in.size() == 1 ? out : in;
            face(cut(one, three[0]), cut(one, three[1]), cut(one, three[2]), way);
          }
        }
  return shape;
}

using Outline = std::vector<std::array<double, 2>>;

/// Triangles of a simple outline that runs to the left, ear by ear: long and thin ones, as CAD
/// programs make them.
inline std::vector<std::array<Index, 3>> clip_ears(const Outline& outline) {
  const auto turn = [&](Index a, Index b, Index c) {
    const auto &p = outline[a], &q = outline[b], &r = outline[c];
    return (q[0] - p[0]) * (r[1] - p[1]) - (q[1] - p[1]) * (r[0] - p[0]);
  };
  std::vector<Index> left(outline.size());
  for (Index i = 0; i < left.size(); ++i) left[i] = i;
  std::vector<std::array<Index, 3>> faces;
  for (std::size_t at = 0, idle = 0; left.size() > 3 && idle <= left.size(); ++at) {
    const std::size_t n = left.size(), i = at % n;
    const Index a = left[(i + n - 1) % n], b = left[i], c = left[(i + 1) % n];
    bool ear = turn(a, b, c) > 1e-9;
    for (const Index p : left)
      if (p != a && p != b && p != c && turn(a, b, p) >= 0 && turn(b, c, p) >= 0 &&
          turn(c, a, p) >= 0)
        ear = false;
    idle = ear ? 0 : idle + 1;
    if (!ear) continue;
    faces.push_back({a, b, c});
    left.erase(left.begin() + static_cast<std::ptrdiff_t>(i));
  }
  if (left.size() == 3) faces.push_back({left[0], left[1], left[2]});
  return faces;
}

/// A prism over an outline, with walls of so many layers and caps of its own vertices alone.
inline Shape extruded(const Outline& outline, double height, Index layers) {
  Shape shape;
  const auto n = static_cast<Index>(outline.size());
  for (Index l = 0; l <= layers; ++l)
    for (const auto& [x, y] : outline) shape.add({x, y, height * l / layers});
  for (Index l = 0; l < layers; ++l)
    for (Index i = 0; i < n; ++i) {
      const Index a = l * n + i, b = l * n + (i + 1) % n;
      add_quad(shape, a, b, b + n, a + n);
    }
  for (const auto& [a, b, c] : clip_ears(outline)) {
    shape.faces.push_back({c, b, a});
    shape.faces.push_back({layers * n + a, layers * n + b, layers * n + c});
  }
  return shape;
}

/// The surface of all voxels that are full. Where full voxels touch in an edge only it is no
/// manifold.
inline Shape voxels(Index n, const std::function<bool(int, int, int)>& full) {
  Shape shape;
  std::map<std::array<int, 3>, Index> corner;
  const auto at = [&](std::array<int, 3> p) {
    const auto [found, fresh] = corner.try_emplace(p, 0);
    if (fresh) found->second = shape.add({1.0 * p[0] / n, 1.0 * p[1] / n, 1.0 * p[2] / n});
    return found->second;
  };
  const int m = static_cast<int>(n);
  const auto has = [&](std::array<int, 3> p) {
    for (const int x : p)
      if (x < 0 || x >= m) return false;
    return full(p[0], p[1], p[2]);
  };
  for (int z = 0; z < m; ++z)
    for (int y = 0; y < m; ++y)
      for (int x = 0; x < m; ++x)
        for (std::size_t axis = 0; axis < 3; ++axis)
          for (const int side : {0, 1}) {
            std::array<int, 3> p = {x, y, z}, beyond = p;
            beyond[axis] += side == 0 ? -1 : 1;
            if (!has(p) || has(beyond)) continue;
            p[axis] += side;
            const std::size_t u = (axis + 1) % 3, v = (axis + 2) % 3;
            std::array<int, 3> q = p, r = p, s = p;
            ++q[u], ++r[u], ++r[v], ++s[v];
            if (side == 1)
              add_quad(shape, at(p), at(q), at(r), at(s));
            else
              add_quad(shape, at(p), at(s), at(r), at(q));
          }
  return shape;
}

/// A sum of soft bumps at places drawn by chance, from -1 to 1 or so.
class SoftNoise {
 public:
  SoftNoise(std::uint64_t seed, int bumps, double width, double reach) : width_(width) {
    Noise noise(seed);
    for (int i = 0; i < bumps; ++i)
      bumps_.push_back({reach * noise(), reach * noise(), reach * noise(), noise()});
  }
  double operator()(const Point& p) const {
    double sum = 0;
    for (const auto& [x, y, z, weight] : bumps_) {
      const Point d = p - Point{x, y, z};
      sum += weight * std::exp(-dot(d, d) / (width_ * width_));
    }
    return sum;
  }

 private:
  double width_;
  std::vector<std::array<double, 4>> bumps_;
};

}  // namespace samples
