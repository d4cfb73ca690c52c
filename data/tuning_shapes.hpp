#pragma once

// The surfaces that `plexway tune` is trained on, and others, of other kinds, that it never sees
// and by which the outcome is judged. docs/log/tuning.md says more.

#include <string_view>

#include "surface_makers.hpp"

namespace samples {

struct TuningShape {
  std::string_view name;
  std::string_view about;
  Shape (*make)();
};

namespace tuning {

inline double even(Point) { return 0.018; }

/// Directions on a sphere, a spiral of equal steps in height, moved about.
inline std::vector<Point> spiral(std::size_t count, double jitter, std::uint64_t seed) {
  Noise noise(seed);
  std::vector<Point> points;
  const double golden = pi * (3 - std::sqrt(5.0)),
               side = jitter / std::sqrt(static_cast<double>(count));
  for (std::size_t i = 0; i < count; ++i) {
    const double z = 1 - (2 * static_cast<double>(i) + 1) / static_cast<double>(count);
    const double r = std::sqrt(1 - z * z), a = golden * static_cast<double>(i);
    points.push_back(unit(
        {r * std::cos(a) + side * noise(), r * std::sin(a) + side * noise(), z + side * noise()}));
  }
  return points;
}

inline Shape hull_of(std::vector<Point> points) {
  Shape shape;
  shape.faces = convex_hull(points);
  shape.points = std::move(points);
  return shape;
}

template <class Height>
Shape raised(Shape shape, const Height& height) {
  for (Point& p : shape.points) p[2] = height(p[0], p[1]);
  return compact(shape);
}

// ---- To train on ----

inline Shape sphere_even() { return geodesic_sphere(11); }
inline Shape sphere_rings() {  // needles at the poles
  std::vector<std::array<double, 2>> profile;
  for (int i = 0; i <= 40; ++i)
    profile.push_back({i % 40 ? std::sin(pi * i / 40) : 0, -std::cos(pi * i / 40)});
  return revolution(profile, 32);
}
inline Shape sphere_scattered() { return hull_of(spiral(1500, 0.6, 21)); }
inline Shape ring_sheared() {
  return grid(72, 24, true, true, Cut::one_way, [](double u, double v) {
    const double a = 2 * pi * u, b = 2 * pi * (v + 2 * u), r = 1 + 0.35 * std::cos(b);
    return Point{r * std::cos(a), r * std::sin(a), 0.35 * std::sin(b)};
  });
}
inline Shape trefoil() {
  return tube(
      150, 12, true,
      [](double t) {
        const double a = 2 * pi * t;
        return Point{std::sin(a) + 2 * std::sin(2 * a), std::cos(a) - 2 * std::cos(2 * a),
                     -std::sin(3 * a)};
      },
      [](double) { return 0.5; });
}
inline Shape saddle() {
  return raised(delaunay(scattered(1500, 31, even)), [](double x, double y) {
    return 1.2 * (x - 0.5) * (x - 0.5) - 1.2 * (y - 0.5) * (y - 0.5);
  });
}
inline Shape monkey_saddle() {
  return grid(40, 40, false, false, Cut::one_way, [](double u, double v) {
    const double x = 2 * u - 1, y = 2 * v - 1;
    return Point{x, y, 0.4 * (x * x * x - 3 * x * y * y)};
  });
}
inline Shape waves() {  // long cells, all cut the same way
  return grid(80, 26, false, false, Cut::one_way, [](double u, double v) {
    return Point{u, v, 0.06 * std::sin(11 * u + 1) * std::cos(8 * v + 2 * u)};
  });
}
inline Shape terrain() {
  const SoftNoise wide(41, 30, 0.25, 1.2), fine(42, 300, 0.06, 1.1);
  return raised(delaunay(scattered(1800, 43, even)), [&](double x, double y) {
    return 0.3 * wide({x, y, 0}) + 0.05 * fine({x, y, 0});
  });
}
inline Shape graded_hill() {  // triangles grow by 20 away from one corner
  const auto spacing = [](Point p) { return 0.004 + 0.06 * std::sqrt(dot(p, p)); };
  return raised(delaunay(scattered(1400, 51, spacing)), [](double x, double y) {
    return 0.3 * std::exp(-12 * ((x - 0.3) * (x - 0.3) + (y - 0.4) * (y - 0.4)));
  });
}
inline Shape gear() {  // caps of needles
  Outline outline;
  for (int i = 0; i < 30; ++i)
    for (int k = 0; k < 8; ++k) {
      const double r = k < 4 ? 1.0 : 1.18, a = 2 * pi * (i + k / 8.0) / 30;
      outline.push_back({r * std::cos(a), r * std::sin(a)});
    }
  return extruded(outline, 0.4, 2);
}
inline Shape shaft() {  // as CAD programs turn it: few rings, many sides
  return revolution({{0, 0},
                     {0.5, 0},
                     {0.5, 0.8},
                     {0.8, 0.8},
                     {0.8, 1.6},
                     {0.6, 1.8},
                     {0.6, 3},
                     {0.3, 3},
                     {0.3, 4},
                     {0, 4}},
                    100);
}
inline Shape cone() {
  std::vector<std::array<double, 2>> profile;
  for (int i = 0; i <= 24; ++i)
    profile.push_back({0.8 * std::pow(i / 24.0, 1.6), 1 - std::pow(i / 24.0, 1.6)});
  profile.push_back({0.4, -0.15});
  profile.push_back({0, -0.2});
  return revolution(profile, 48);
}
inline Shape blob() {
  Shape shape = geodesic_sphere(13);
  const SoftNoise wide(61, 40, 0.5, 1), fine(62, 200, 0.2, 1);
  for (Point& p : shape.points) p = (1 + 0.22 * wide(p) + 0.05 * fine(p)) * p;
  return shape;
}
inline Shape rough_ball() {
  Shape shape = geodesic_sphere(12);
  Noise noise(71);
  for (Point& p : shape.points) p = (1 + 0.012 * noise()) * p;
  return shape;
}
inline Shape holes() {  // flat; paths bend at the rims
  Shape shape = delaunay(scattered(2000, 81, even));
  const auto inside = [&](const std::array<Index, 3>& face) {
    double x = 0, y = 0;
    for (const Index v : face) x += shape.points[v][0] / 3, y += shape.points[v][1] / 3;
    for (const auto& [cx, cy, r] :
         {std::array{0.3, 0.3, 0.15}, std::array{0.7, 0.45, 0.12}, std::array{0.4, 0.75, 0.17}})
      if (std::hypot(x - cx, y - cy) < r) return true;
    return false;
  };
  std::erase_if(shape.faces, inside);
  return raised(std::move(shape), [](double, double) { return 0.0; });
}
inline Shape gyroid() {
  return level_set(10, -2.3, 2.3, [](Point p) {
    return std::sin(p[0]) * std::cos(p[1]) + std::sin(p[1]) * std::cos(p[2]) +
           std::sin(p[2]) * std::cos(p[0]) + 0.05;
  });
}
inline Shape sponge() {
  return voxels(9, [](int x, int y, int z) {
    for (const int k : {1, 3}) {
      const int a = x / k % 3, b = y / k % 3, c = z / k % 3;
      if ((a == 1) + (b == 1) + (c == 1) >= 2) return false;
    }
    return true;
  });
}
inline Shape cigar() {
  Shape shape = geodesic_sphere(12);
  for (Point& p : shape.points) p = {6 * p[0], p[1], 0.7 * p[2]};
  return shape;
}
inline Shape helicoid() {
  return grid(90, 16, false, false, Cut::by_chance, [](double u, double v) {
    const double a = 3 * pi * u, r = 0.15 + 0.85 * v;
    return Point{r * std::cos(a), r * std::sin(a), 1.5 * u};
  });
}
inline Shape dumbbell() {
  std::vector<std::array<double, 2>> profile;
  for (int i = 0; i <= 44; ++i) {
    const double t = -1 + i / 22.0;
    profile.push_back({i % 44 ? 0.9 * std::sqrt(1 - t * t) * (0.15 + t * t) : 0, 1.6 * t});
  }
  return revolution(profile, 36);
}
inline Shape catenoid() {
  return grid(60, 28, true, false, Cut::by_chance, [](double u, double v) {
    const double z = 2.6 * (v - 0.5), r = 0.6 * std::cosh(z / 0.6 * 0.8);
    return Point{r * std::cos(2 * pi * u), r * std::sin(2 * pi * u), z};
  });
}
inline Shape crumpled() {  // creased both ways, thin triangles by chance
  Shape shape = delaunay(scattered(1500, 91, even));
  const auto fold = [](double x) { return std::abs(x - std::floor(x) - 0.5); };
  shape = raised(std::move(shape), [&](double x, double y) {
    return 0.35 * fold(2.3 * x + 0.7 * y) + 0.25 * fold(1.1 * x - 2.9 * y);
  });
  for (Point& p : shape.points) p[0] *= 3;
  return shape;
}
inline Shape tangle() {
  return level_set(14, -2.6, 2.6, [](Point p) {
    double f = 11.8;
    for (const double x : p) f += x * x * x * x - 5 * x * x;
    return f;
  });
}

inline Shape cinquefoil() {
  return tube(
      170, 11, true,
      [](double t) {
        const double a = 2 * pi * t, r = 2 + 0.8 * std::cos(5 * a);
        return Point{r * std::cos(2 * a), r * std::sin(2 * a), 0.8 * std::sin(5 * a)};
      },
      [](double t) { return 0.28 + 0.07 * std::sin(14 * pi * t); });
}
inline Shape spring() {
  return tube(
      260, 8, false,
      [](double t) {
        const double a = 10 * pi * t;
        return Point{std::cos(a), std::sin(a), 2.2 * t};
      },
      [](double) { return 0.12; });
}

// ---- To judge by ----

inline Shape double_ring() {
  return level_set(19, -1.6, 1.6, [](Point p) {
    const double x = p[0], y = p[1], z = p[2];
    const double left = std::hypot(x + 0.62, y) - 0.55, right = std::hypot(x - 0.62, y) - 0.55;
    const double ring = std::min(left * left, right * right);
    return ring + z * z - 0.05 + 0.02 * std::sin(3 * x + 2 * y);
  });
}
inline Shape figure_eight() {  // the knot
  return tube(
      210, 9, true,
      [](double t) {
        const double a = 2 * pi * t, r = 2 + std::cos(2 * a);
        return Point{r * std::cos(3 * a), r * std::sin(3 * a), 1.1 * std::sin(4 * a)};
      },
      [](double) { return 0.3; });
}
inline Shape ridges() {
  const SoftNoise wide(141, 40, 0.3, 1.2);
  const auto spacing = [](Point) { return 0.016; };
  return raised(delaunay(scattered(2200, 143, spacing)), [&](double x, double y) {
    const double w = wide({x, y, 0});
    return 0.25 * std::abs(w) + 0.03 * std::sin(25 * x + 9 * w);
  });
}
inline Shape heat_sink() {
  Outline outline = {{0, 0}, {6, 0}};
  for (int fin = 59; fin >= 0; --fin) {
    const double x = fin / 10.0;
    for (const auto& [dx, y] :
         {std::array{0.1, 2.0}, std::array{0.04, 2.0}, std::array{0.04, 0.5}, std::array{0.0, 0.5}})
      outline.push_back({x + dx, y});
  }
  outline.pop_back();
  return extruded(outline, 1.5, 2);
}
inline Shape horn() {  // a snail's, open at both ends
  return tube(
      140, 14, false,
      [](double t) {
        const double a = 7 * pi * t, r = 0.35 + 1.3 * t;
        return Point{r * std::cos(a), r * std::sin(a), 2.4 * t * t};
      },
      [](double t) { return 0.06 + 0.3 * t; });
}
inline Shape windows() {  // the shell of a tower
  Shape shape = grid(64, 40, true, false, Cut::shorter, [](double u, double v) {
    const double r = 1 + 0.15 * std::sin(2 * pi * v);
    return Point{r * std::cos(2 * pi * u), r * std::sin(2 * pi * u), 3 * v};
  });
  std::size_t cell = 0;
  std::erase_if(shape.faces, [&](const auto&) {
    const std::size_t u = cell / 2 / 40, v = cell / 2 % 40;
    ++cell;
    return u % 8 >= 3 && u % 8 < 6 && v % 10 >= 4 && v % 10 < 8;
  });
  return compact(shape);
}
inline Shape cup() {
  return revolution({{0, 0},
                     {0.5, 0},
                     {0.6, 0.05},
                     {0.7, 0.4},
                     {0.75, 0.8},
                     {0.8, 1.2},
                     {0.85, 1.6},
                     {0.83, 1.65},
                     {0.8, 1.6},
                     {0.75, 1.2},
                     {0.7, 0.8},
                     {0.65, 0.4},
                     {0.5, 0.12},
                     {0.25, 0.1},
                     {0, 0.1}},
                    70);
}
inline Shape pipes() {  // Schwarz P
  return level_set(12, -2.9, 2.9, [](Point p) {
    return std::cos(1.3 * p[0]) + std::cos(1.3 * p[1]) + std::cos(1.3 * p[2]) - 0.2;
  });
}
inline Shape rough_egg() {
  Shape shape = hull_of(spiral(1800, 1.0, 161));
  Noise noise(162);
  for (Point& p : shape.points) {
    const double s = 1 + 0.01 * noise();
    p = {1.6 * s * p[0], s * p[1], s * (1 + 0.3 * p[0]) * p[2]};
  }
  return shape;
}
inline Shape terraces() {  // cliffs of tall thin triangles
  const SoftNoise wide(171, 25, 0.35, 1.2);
  return raised(delaunay(scattered(1800, 173, even)), [&](double x, double y) {
    const double h = 5 * (wide({x, y, 0}) + 2), step = std::floor(h);
    return 0.08 * (step + std::clamp(4 * (h - step) - 1.5, 0.0, 1.0));
  });
}
inline Shape pillow() {  // a rounded cube
  Shape shape = geodesic_sphere(14);
  for (Point& p : shape.points) {
    const double s = std::pow(p[0], 6) + std::pow(p[1], 6) + std::pow(p[2], 6);
    p = std::pow(s, -1.0 / 6) * p;
  }
  return shape;
}
inline Shape roof() {  // long rectangles in zigzag, as a corrugated sheet
  return grid(120, 9, false, false, Cut::one_way, [](double u, double v) {
    const double x = 12 * u - std::floor(12 * u);
    return Point{2 * u, 3 * v, 0.12 * std::abs(x - 0.5) + 0.1 * std::sin(3 * v)};
  });
}

inline constexpr std::array training = {
    TuningShape{"sphere_even", "icosahedron, cut", sphere_even},
    TuningShape{"sphere_rings", "meridians and parallels", sphere_rings},
    TuningShape{"sphere_scattered", "Delaunay of a moved spiral", sphere_scattered},
    TuningShape{"torus", "shorter diagonals", samples::torus},
    TuningShape{"ring_sheared", "torus of sheared cells", ring_sheared},
    TuningShape{"trefoil", "tube around a knot", trefoil},
    TuningShape{"saddle", "Delaunay of scattered points", saddle},
    TuningShape{"monkey_saddle", "square grid, one diagonal", monkey_saddle},
    TuningShape{"waves", "height field of long cells", waves},
    TuningShape{"terrain", "noise on two scales", terrain},
    TuningShape{"graded_hill", "triangles from small to large", graded_hill},
    TuningShape{"gear", "CAD: extruded, ears and long walls", gear},
    TuningShape{"shaft", "CAD: turned, few rings", shaft},
    TuningShape{"cone", "a tip, a crease, a graded side", cone},
    TuningShape{"blob", "smooth noise on a sphere", blob},
    TuningShape{"rough_ball", "noise at each vertex", rough_ball},
    TuningShape{"holes", "flat with three round holes", holes},
    TuningShape{"gyroid", "level set, marching tetrahedra", gyroid},
    TuningShape{"sponge", "Menger's, second level", sponge},
    TuningShape{"cigar", "stretched sphere", cigar},
    TuningShape{"helicoid", "negative curvature, cut by chance", helicoid},
    TuningShape{"dumbbell", "a thin neck", dumbbell},
    TuningShape{"catenoid", "open at both ends", catenoid},
    TuningShape{"crumpled", "creases; stretched triangles", crumpled},
    TuningShape{"cinquefoil", "tube of changing width around a knot", cinquefoil},
    TuningShape{"spring", "open tube", spring},
    TuningShape{"tangle", "level set of many handles", tangle},
};

inline constexpr std::array validation = {
    TuningShape{"double_ring", "two handles, level set", double_ring},
    TuningShape{"figure_eight", "tube around the knot", figure_eight},
    TuningShape{"ridges", "height field with sharp ridges", ridges},
    TuningShape{"heat_sink", "CAD: comb, extruded", heat_sink},
    TuningShape{"horn", "open tube that winds and widens", horn},
    TuningShape{"windows", "shell with rectangular holes", windows},
    TuningShape{"cup", "turned, inside and outside", cup},
    TuningShape{"pipes", "Schwarz's P, level set", pipes},
    TuningShape{"rough_egg", "Delaunay of scattered points, noise", rough_egg},
    TuningShape{"terraces", "cliffs of thin triangles", terraces},
    TuningShape{"pillow", "rounded cube", pillow},
    TuningShape{"roof", "zigzag of long cells", roof},
};

}  // namespace tuning
}  // namespace samples
