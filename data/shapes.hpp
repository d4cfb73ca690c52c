#pragma once

// The samples as functions. Only the standard library, no randomness but its own, so that
// a shape is the same wherever it is made.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <functional>
#include <map>
#include <numbers>
#include <utility>
#include <vector>

namespace samples {

using Point = std::array<double, 3>;
using Index = std::uint32_t;

struct Shape {
  std::vector<Point> points;
  std::vector<std::array<Index, 3>> faces;
  std::vector<std::array<Index, 4>> tets;   // of solids, which have no faces
  std::vector<std::array<Index, 2>> lines;  // of wireframes

  Index add(Point p) {
    points.push_back(p);
    return static_cast<Index>(points.size() - 1);
  }
};

inline constexpr double pi = std::numbers::pi;

inline Point operator+(Point a, Point b) { return {a[0] + b[0], a[1] + b[1], a[2] + b[2]}; }
inline Point operator-(Point a, Point b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }
inline Point operator*(double s, Point a) { return {s * a[0], s * a[1], s * a[2]}; }
inline double dot(Point a, Point b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
inline Point cross(Point a, Point b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
inline Point unit(Point a) { return (1 / std::sqrt(dot(a, a))) * a; }

/// Numbers in [-1, 1) by the splitmix64 sequence.
class Noise {
 public:
  explicit Noise(std::uint64_t seed) : state_(seed) {}
  double operator()() {
    std::uint64_t z = state_ += 0x9E3779B97F4A7C15ULL;
    z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9ULL;
    z = (z ^ (z >> 27)) * 0x94D049BB133111EBULL;
    z ^= z >> 31;
    return static_cast<double>(z >> 11) / static_cast<double>(1ULL << 52) - 1;
  }

 private:
  std::uint64_t state_;
};

/// The two triangles of the quad a, b, c, d (in cyclic order), cut along its shorter diagonal.
inline void add_quad(Shape& shape, Index a, Index b, Index c, Index d) {
  const Point ac = shape.points[c] - shape.points[a];
  const Point bd = shape.points[d] - shape.points[b];
  if (dot(ac, ac) <= dot(bd, bd)) {
    shape.faces.push_back({a, b, c});
    shape.faces.push_back({a, c, d});
  } else {
    shape.faces.push_back({a, b, d});
    shape.faces.push_back({b, c, d});
  }
}

/// A closed grid of `rings` rings with `sides` points each, ring after ring.
inline void add_tube_faces(Shape& shape, Index rings, Index sides) {
  for (Index i = 0; i < rings; ++i)
    for (Index j = 0; j < sides; ++j) {
      const Index next_ring = (i + 1) % rings * sides;
      const Index next = (j + 1) % sides;
      add_quad(shape, i * sides + j, next_ring + j, next_ring + next, i * sides + next);
    }
}

/// A sphere: each face of an icosahedron cut into n * n triangles, 10 n^2 + 2 vertices.
inline Shape geodesic_sphere(Index n) {
  const double g = std::numbers::phi;
  const std::array<Point, 12> corner = {{{-1, g, 0},
                                         {1, g, 0},
                                         {-1, -g, 0},
                                         {1, -g, 0},
                                         {0, -1, g},
                                         {0, 1, g},
                                         {0, -1, -g},
                                         {0, 1, -g},
                                         {g, 0, -1},
                                         {g, 0, 1},
                                         {-g, 0, -1},
                                         {-g, 0, 1}}};
  constexpr std::array<std::array<Index, 3>, 20> face = {
      {{0, 11, 5},  {0, 5, 1},  {0, 1, 7},  {0, 7, 10}, {0, 10, 11}, {1, 5, 9}, {5, 11, 4},
       {11, 10, 2}, {10, 7, 6}, {7, 1, 8},  {3, 9, 4},  {3, 4, 2},   {3, 2, 6}, {3, 6, 8},
       {3, 8, 9},   {4, 9, 5},  {2, 4, 11}, {6, 2, 10}, {8, 6, 7},   {9, 8, 1}}};
  Shape shape;
  for (const Point& p : corner) shape.add(unit(p));
  std::map<std::pair<Index, Index>, std::vector<Index>> edges;  // from the lower to the higher end
  const auto edge = [&](Index from, Index to) {
    auto& line = edges[std::minmax(from, to)];
    if (line.empty()) {
      const auto [low, high] = std::minmax(from, to);
      for (Index k = 0; k <= n; ++k) {
        const double t = static_cast<double>(k) / n;
        line.push_back(k == 0   ? low
                       : k == n ? high
                                : shape.add(unit((1 - t) * corner[low] + t * corner[high])));
      }
    }
    return from < to ? line : std::vector<Index>(line.rbegin(), line.rend());
  };
  for (const auto& [a, b, c] : face) {
    const auto left = edge(a, b);  // row i runs from left[i] to right[i]
    const auto right = edge(a, c);
    const auto bottom = edge(b, c);
    std::vector<Index> above = {a};
    for (Index i = 1; i <= n; ++i) {
      std::vector<Index> row = {left[i]};
      for (Index j = 1; j < i; ++j) {
        const double u = static_cast<double>(n - i) / n;
        const double v = static_cast<double>(i - j) / n;
        const double w = static_cast<double>(j) / n;
        row.push_back(i == n ? bottom[j]
                             : shape.add(unit(u * corner[a] + v * corner[b] + w * corner[c])));
      }
      row.push_back(right[i]);
      for (Index j = 0; j < i; ++j) {
        shape.faces.push_back({above[j], row[j], row[j + 1]});
        if (j + 1 < i) shape.faces.push_back({above[j], row[j + 1], above[j + 1]});
      }
      above = std::move(row);
    }
  }
  return shape;
}

/// A closed surface with hills and saddles everywhere: the same one at any resolution.
inline Shape bumpy(Index n) {
  Shape shape = geodesic_sphere(n);
  for (Point& p : shape.points) {
    const double wide = std::sin(3 * p[0] + 0.5) * std::sin(3 * p[1] + 1) * std::sin(3 * p[2] + 2);
    const double fine = std::sin(9 * p[0]) + std::sin(11 * p[1] + 1) + std::sin(10 * p[2] + 2);
    p = (1 + 0.3 * wide + 0.03 * fine) * p;
  }
  return shape;
}

inline Shape torus() {
  Shape shape;
  constexpr Index rings = 48;
  constexpr Index sides = 24;
  for (Index i = 0; i < rings; ++i)
    for (Index j = 0; j < sides; ++j) {
      const double u = 2 * pi * i / rings;
      const double v = 2 * pi * j / sides;
      const double r = 1 + 0.4 * std::cos(v);
      shape.add({r * std::cos(u), r * std::sin(u), 0.4 * std::sin(v)});
    }
  add_tube_faces(shape, rings, sides);
  return shape;
}

/// A tube around the trefoil knot. The frame is carried along without twist; the rest of a turn
/// that is missing at the end is spread over the whole length.
inline Shape knot() {
  constexpr Index rings = 256;
  constexpr Index sides = 20;
  const auto centre = [](double t) {
    return Point{std::sin(t) + 2 * std::sin(2 * t), std::cos(t) - 2 * std::cos(2 * t),
                 -std::sin(3 * t)};
  };
  std::vector<Point> at;
  std::vector<Point> tangent;
  for (Index i = 0; i < rings; ++i) {
    const double t = 2 * pi * i / rings;
    at.push_back(centre(t));
    tangent.push_back(unit(centre(t + 1e-4) - centre(t - 1e-4)));
  }
  const auto square_to = [](Point normal, Point along) {
    return unit(normal - dot(normal, along) * along);
  };
  std::vector<Point> normal = {square_to({0, 0, 1}, tangent[0])};
  for (Index i = 1; i < rings; ++i) normal.push_back(square_to(normal.back(), tangent[i]));
  const Point end = square_to(normal.back(), tangent[0]);
  const double missing = std::atan2(dot(cross(end, normal[0]), tangent[0]), dot(end, normal[0]));

  Shape shape;
  for (Index i = 0; i < rings; ++i) {
    const Point sideways = cross(tangent[i], normal[i]);
    for (Index j = 0; j < sides; ++j) {
      const double v = 2 * pi * j / sides + missing * i / rings;
      shape.add(at[i] + (0.45 * std::cos(v)) * normal[i] + (0.45 * std::sin(v)) * sideways);
    }
  }
  add_tube_faces(shape, rings, sides);
  return shape;
}

/// A square of (n + 1)^2 points, moved about unless they lie on `keeps` lines.
inline Shape jittered_square(Index n, double side, double jitter, std::uint64_t seed,
                             const std::function<bool(Index, Index)>& keeps) {
  Shape shape;
  Noise noise(seed);
  const double step = side / n;
  for (Index i = 0; i <= n; ++i)
    for (Index j = 0; j <= n; ++j) {
      const double dx = jitter * step * noise();
      const double dy = jitter * step * noise();
      const bool inner = i != 0 && j != 0 && i != n && j != n && !keeps(i, j);
      shape.add({step * i + (inner ? dx : 0), step * j + (inner ? dy : 0), 0});
    }
  return shape;
}

inline void add_square_faces(Shape& shape, Index n, const std::function<bool(Index, Index)>& has) {
  for (Index i = 0; i < n; ++i)
    for (Index j = 0; j < n; ++j)
      if (has(i, j)) {
        const Index a = i * (n + 1) + j;
        add_quad(shape, a, a + n + 1, a + n + 2, a + 1);
      }
}

/// An open height field on irregular points.
inline Shape hills() {
  constexpr Index n = 36;
  Shape shape = jittered_square(n, 4, 0.35, 7, [](Index, Index) { return false; });
  for (Point& p : shape.points) {
    const double x = p[0] - 2;
    const double y = p[1] - 2;
    p[2] = 0.9 * std::exp(-2 * ((x - 0.6) * (x - 0.6) + (y + 0.5) * (y + 0.5))) -
           0.6 * std::exp(-3 * ((x + 0.8) * (x + 0.8) + (y - 0.7) * (y - 0.7))) +
           0.12 * std::sin(3 * x) * std::cos(4 * y);
  }
  add_square_faces(shape, n, [](Index, Index) { return true; });
  return shape;
}

/// Drops points that no face uses.
inline Shape compact(const Shape& shape) {
  constexpr Index unused = ~Index{0};
  std::vector<Index> number(shape.points.size(), unused);
  for (const auto& face : shape.faces)
    for (const Index v : face) number[v] = 0;
  Shape out;
  for (Index i = 0; i < number.size(); ++i)
    if (number[i] != unused) number[i] = out.add(shape.points[i]);
  for (const auto& [a, b, c] : shape.faces) out.faces.push_back({number[a], number[b], number[c]});
  return out;
}

/// Flat, L-shaped: the square [0, 2]^2 without [1, 2]^2. Paths bend at (1, 1).
inline Shape ell() {
  constexpr Index n = 24;
  constexpr Index half = n / 2;
  Shape shape = jittered_square(n, 2, 0.3, 11, [](Index i, Index j) {
    return (i == half && j >= half) || (j == half && i >= half);
  });
  add_square_faces(shape, n, [](Index i, Index j) { return i < half || j < half; });
  return compact(shape);
}

/// Flat: the square [0, 2]^2, slit from (1, 0) to (1, 1.5). The slit's points are there twice.
inline Shape slit() {
  constexpr Index n = 20;
  constexpr Index half = n / 2;
  constexpr Index tip = 15;
  Shape shape =
      jittered_square(n, 2, 0.3, 13, [](Index i, Index j) { return i == half && j <= tip; });
  add_square_faces(shape, n, [](Index, Index) { return true; });
  std::map<Index, Index> twin;
  for (Index j = 0; j < tip; ++j) {
    const Index v = half * (n + 1) + j;
    twin[v] = shape.add(Point(shape.points[v]));
  }
  for (auto& face : shape.faces) {
    double x = 0;
    for (const Index v : face) x += shape.points[v][0] / 3;
    if (x > 1)
      for (Index& v : face)
        if (const auto other = twin.find(v); other != twin.end()) v = other->second;
  }
  return shape;
}

/// Half a turn: not orientable, one boundary.
inline Shape moebius() {
  constexpr Index around = 90;
  constexpr Index across = 6;
  Shape shape;
  for (Index i = 0; i < around; ++i)
    for (Index j = 0; j <= across; ++j) {
      const double u = 2 * pi * i / around;
      const double w = 0.6 * (static_cast<double>(j) / across - 0.5);
      const double r = 1 + w * std::cos(u / 2);
      shape.add({r * std::cos(u), r * std::sin(u), w * std::sin(u / 2)});
    }
  for (Index i = 0; i < around; ++i)
    for (Index j = 0; j < across; ++j) {
      const bool last = i + 1 == around;
      const auto next = [&](Index k) { return last ? across - k : (i + 1) * (across + 1) + k; };
      const Index a = i * (across + 1) + j;
      add_quad(shape, a, next(j), next(j + 1), a + 1);
    }
  return shape;
}

/// Two spheres that do not touch, and a point that belongs to neither.
inline Shape two_parts() {
  Shape shape = geodesic_sphere(5);
  const auto first = static_cast<Index>(shape.points.size());
  const Shape other = geodesic_sphere(4);
  for (const Point& p : other.points) shape.add(Point{3, 0, 0} + 0.5 * p);
  for (const auto& [a, b, c] : other.faces)
    shape.faces.push_back({a + first, b + first, c + first});
  shape.add({1.75, 0, 0});
  return shape;
}

/// The surface of a box of 3 x 2 x 1, as a soup: each face has its own points on the edges.
inline Shape box() {
  constexpr std::array<double, 3> size = {3, 2, 1};
  constexpr Index n = 6;
  Shape shape;
  for (std::size_t axis = 0; axis < 3; ++axis)
    for (const bool far : {false, true}) {
      const std::size_t u = (axis + 1) % 3;
      const std::size_t v = (axis + 2) % 3;
      const auto first = static_cast<Index>(shape.points.size());
      for (Index i = 0; i <= n; ++i)
        for (Index j = 0; j <= n; ++j) {
          Point p{};
          p[axis] = far ? size[axis] : 0;
          p[u] = size[u] * i / n;
          p[v] = size[v] * j / n;
          shape.add(p);
        }
      for (Index i = 0; i < n; ++i)
        for (Index j = 0; j < n; ++j) {
          const Index a = first + i * (n + 1) + j;
          const Index b = a + n + 1;
          if (far)
            add_quad(shape, a, b, b + 1, a + 1);
          else
            add_quad(shape, a, a + 1, b + 1, b);
        }
    }
  return shape;
}

}  // namespace samples
