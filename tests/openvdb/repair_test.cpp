// Surfaces that TetGen refuses, and what becomes of them.

#include <plexway/openvdb/surface.hpp>

#include "data/solid_shapes.hpp"
#include "volumes.hpp"

#ifdef PLEXWAY_HAS_TETGEN
#include <plexway/tetgen/tetrahedralize.hpp>
#endif

namespace repair_test {

using namespace volume_testing;
using Catch::Contains;
using plexway::openvdb::Repair;

namespace {

Shape together(Shape first, const Shape& second, Point move, double scale = 1) {
  const auto offset = static_cast<Index>(first.points.size());
  for (const Point& p : second.points) first.points.push_back(scale * p + move);
  for (const auto& [a, b, c] : second.faces)
    first.faces.push_back({a + offset, b + offset, c + offset});
  return first;
}

Shape without_faces(Shape shape, const std::function<bool(const Point&)>& drop) {
  std::erase_if(shape.faces, [&](const auto& f) {
    return drop((1.0 / 3) * (shape.points[f[0]] + shape.points[f[1]] + shape.points[f[2]]));
  });
  return shape;
}

/// The figure-8 immersion of the Klein bottle, `n` by `n`.
Shape klein_bottle(Index n) {
  Shape shape;
  for (Index i = 0; i < n; ++i)
    for (Index j = 0; j < n; ++j) {
      const double u = 2 * pi * i / n, v = 2 * pi * j / n;
      const double r = 2 + std::cos(u / 2) * std::sin(v) - std::sin(u / 2) * std::sin(2 * v);
      const double z = std::sin(u / 2) * std::sin(v) + std::cos(u / 2) * std::sin(2 * v);
      shape.add({r * std::cos(u), r * std::sin(u), z});
    }
  // After a turn the figure-8 is upside down: v goes to -v.
  const auto at = [&](Index i, Index j) { return i < n ? i * n + j % n : (n - j % n) % n; };
  for (Index i = 0; i < n; ++i)
    for (Index j = 0; j < n; ++j) {
      shape.faces.push_back({at(i, j), at(i + 1, j), at(i + 1, j + 1)});
      shape.faces.push_back({at(i, j), at(i + 1, j + 1), at(i, j + 1)});
    }
  return shape;
}

Shape box_at(double side) {
  Shape shape;
  for (int i = 0; i < 8; ++i) shape.add({side * (i & 1), side * (i >> 1 & 1), side * (i >> 2)});
  for (const auto& [a, b, c, d] : std::vector<std::array<Index, 4>>{
           {0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}}) {
    shape.faces.push_back({a, b, c});
    shape.faces.push_back({a, c, d});
  }
  return shape;
}

double ball_volume(double r) { return 4 * pi / 3 * r * r * r; }

struct Case {
  const char* name;
  Shape shape;
  double volume;  ///< of what must come out; 0: only that it does
  double within;
  const char* told;     ///< in the report
  bool refused = true;  ///< by TetGen
};

std::vector<Case> broken_surfaces() {
  const Shape sphere = geodesic_sphere(12);
  // Two unit spheres 1 apart: each loses a cap of height 1/2.
  const double cap = pi * 0.25 * (3 - 0.5) / 3;
  Shape flipped = sphere;
  for (std::size_t f = 0; f < flipped.faces.size(); f += 3)
    std::swap(flipped.faces[f][0], flipped.faces[f][1]);
  Shape doubled = sphere;
  for (std::size_t f = 0; f < sphere.faces.size(); f += 2) doubled.faces.push_back(sphere.faces[f]);
  Shape needle = sphere;
  needle.faces.push_back({0, 0, 1});
  needle.faces.push_back({3, 4, 3});
  Shape soup;  // every triangle with corners of its own, a little shrunk
  for (const auto& f : sphere.faces) {
    const auto first = static_cast<Index>(soup.points.size());
    const Point middle =
        (1.0 / 3) * (sphere.points[f[0]] + sphere.points[f[1]] + sphere.points[f[2]]);
    for (const Index v : f) soup.add(middle + 1.02 * (sphere.points[v] - middle));
    soup.faces.push_back({first, first + 1, first + 2});
  }
  const Shape sheet = hills();
  return {
      {"two spheres that cross", together(sphere, sphere, {1, 0, 0}), 2 * (ball_volume(1) - cap),
       0.02, ""},
      {"eight spheres that cross",
       [&] {
         Shape all = sphere;
         for (int i = 1; i < 8; ++i)
           all = together(all, sphere, {0.9 * (i & 1), 0.9 * (i >> 1 & 1), 0.9 * (i >> 2)});
         return all;
       }(),
       0, 0, ""},
      {"two spheres that nearly coincide", together(sphere, sphere, {1e-7, 0, 0}), ball_volume(1),
       0.02, ""},
      {"a hole", without_faces(sphere, [](const Point& p) { return p[2] > 0.93; }),
       ball_volume(1) - pi * 0.07 * 0.07 * (3 - 0.07) / 3, 0.03, "1 hole closed"},
      {"holes in three places",
       without_faces(sphere,
                     [](const Point& p) {
                       return std::max({p[0], p[1], p[2]}) > 0.95;
                     }),
       ball_volume(1), 0.04, "3 holes closed"},
      {"triangles turned over", flipped, ball_volume(1), 0.02, "", false},
      {"triangles there twice", doubled, ball_volume(1), 0.02, "there before"},
      {"triangles without area", needle, ball_volume(1), 0.02, "without area"},
      {"a sphere and a hanging sheet", together(sphere, sheet, {0, 0, 3}), ball_volume(1), 0.02,
       "1 open sheet"},
      {"two boxes that share a part of a side", together(box_at(1), box_at(1), {1, 0.3, 0.2}), 2,
       0.03, ""},
      {"a cup",
       without_faces(together({}, geodesic_sphere(8), {0, 0, 0}),
                     [](const Point& p) { return p[2] > 0.6; }),
       0, 0, "1 hole closed"},
      {"a Klein bottle", klein_bottle(60), 0, 0, "", false},
  };
}

}  // namespace

TEST_CASE("surfaces that TetGen refuses become closed ones") {
  for (const Case& one : broken_surfaces()) {
    INFO(one.name);
    const double voxel = one.volume > 0 ? 0.06 : 0.09;
    Repair report;
    const LevelSet level_set = plexway::openvdb::level_set_of(one.shape.points, one.shape.faces,
                                                              {.voxel = voxel, .report = &report});
    INFO(report.text());
    CHECK_THAT(report.text(), Contains("voxel 0.0") && Contains(one.told));
    const auto surface = plexway::openvdb::surface_of(level_set);
    CHECK(unpaired_edges(surface) == 0);
    if (one.volume > 0) CHECK(enclosed(surface) == Approx(one.volume).epsilon(one.within));
    const auto solid = plexway::openvdb::fill(level_set);
    CHECK(volume(solid) == Approx(enclosed(surface)).epsilon(1e-9));
#ifdef PLEXWAY_HAS_TETGEN
    if (one.refused)
      CHECK_THROWS_AS(plexway::tetgen::tetrahedralize(one.shape.points, one.shape.faces, {},
                                                      {.max_seconds = 20}),
                      plexway::Error);
    const auto filled = plexway::tetgen::tetrahedralize(
        surface.positions, surface.triangles, {},
        {.quality = false, .keep_surface = true, .max_seconds = 60});
    CHECK(volume(filled) == Approx(enclosed(surface)).epsilon(1e-9));
#endif
  }
}

TEST_CASE("triangles without area are counted, and neither holes nor sheets") {
  Shape box;
  for (int i = 0; i < 8; ++i) box.add({1.0 + (i & 1), 2.0 + (i >> 1 & 1), 3.0 + (i >> 2)});
  box.faces = {{0, 2, 3}, {0, 3, 1}, {4, 5, 7}, {4, 7, 6}, {0, 1, 5}, {0, 5, 4},
               {2, 6, 7}, {2, 7, 3}, {0, 4, 6}, {0, 6, 2}, {1, 3, 7}, {1, 7, 5}};
  struct Case {
    const char* name;
    std::vector<std::array<Index, 3>> more;
    bool split;  ///< the edge 0 1 on one of its sides, at its middle, vertex 8
    std::size_t degenerate, holes;
  };
  const std::vector<Case> cases = {
      {"none", {}, false, 0, 0},
      {"a vertex twice", {{0, 1, 1}}, false, 1, 0},
      {"across an edge", {{0, 1, 8}}, false, 1, 0},
      {"across edges that meet", {{0, 1, 8}, {0, 9, 4}}, false, 2, 0},
      {"off by itself", {{10, 11, 12}}, false, 1, 0},
      {"a stitch", {{0, 1, 8}}, true, 1, 0},
      {"no stitch where one is needed", {}, true, 0, 1},
  };
  for (const Case& one : cases) {
    INFO(one.name);
    Shape shape = box;
    shape.add({1.5, 2, 3});
    shape.add({1, 2, 3.5});
    for (const double x : {1.1, 1.2, 1.3}) shape.add({x, x + 1, x + 2});
    if (one.split) {
      shape.faces[1] = {0, 3, 8};
      shape.faces.push_back({8, 3, 1});
    }
    shape.faces.insert(shape.faces.end(), one.more.begin(), one.more.end());
    Repair report;
    const auto level_set = plexway::openvdb::level_set_of(shape.points, shape.faces,
                                                          {.voxel = 0.04, .report = &report});
    CHECK(report.degenerate == one.degenerate);
    CHECK(report.holes == one.holes);
    CHECK(report.open_edges == 3 * one.holes);
    CHECK(report.sheets == 0);
    CHECK(enclosed(plexway::openvdb::surface_of(level_set)) == Approx(1).epsilon(0.02));
  }
}

TEST_CASE("a hollow is filled, as the documentation says") {
  const Shape shell = together(geodesic_sphere(12), geodesic_sphere(12), {0, 0, 0}, 0.6);
  const auto level_set = plexway::openvdb::level_set_of(shell.points, shell.faces, {.voxel = 0.07});
  CHECK(enclosed(plexway::openvdb::surface_of(level_set)) == Approx(ball_volume(1)).epsilon(0.02));
}

TEST_CASE("what encloses nothing is refused, and it says why") {
  const auto refused = [](const Shape& shape, double voxel) {
    return message_of<plexway::InputError>(
        [&] { (void)plexway::openvdb::level_set_of(shape.points, shape.faces, {.voxel = voxel}); });
  };
  CHECK_THAT(refused(hills(), 0), Contains("encloses nothing") && Contains("rim of a sheet"));
  CHECK_THAT(refused(moebius(), 0), Contains("encloses nothing"));
  Shape small = geodesic_sphere(4);
  for (Point& p : small.points) p = p + Point{1.5, 1.5, 1.5};
  CHECK_THAT(refused(small, 3), Contains("encloses nothing as wide as a voxel"));
  CHECK_THAT(refused({}, 0), Contains("no triangles"));
  Shape flat = geodesic_sphere(2);
  for (Point& p : flat.points) p[2] = 0;
  CHECK_THAT(refused(flat, 0), Contains("encloses nothing"));
  Shape point = geodesic_sphere(2);
  for (Point& p : point.points) p = {1, 1, 1};
  CHECK_THAT(refused(point, 0), Contains("without area"));
  Shape bad = geodesic_sphere(2);
  bad.points[3][1] = std::nan("");
  CHECK_THAT(refused(bad, 0), Contains("vertex 3"));
  bad = geodesic_sphere(2);
  bad.faces[5][1] = 4000;
  CHECK_THAT(refused(bad, 0), Contains("triangle 5 names vertex 4000"));
  const Shape sphere = geodesic_sphere(4);
  CHECK_THROWS_AS(plexway::openvdb::level_set_of(sphere.points, sphere.faces, {.voxel = -1}),
                  plexway::UsageError);
  CHECK_THROWS_AS(plexway::openvdb::level_set_of(sphere.points, sphere.faces, {.voxel = 1e-6}),
                  plexway::UsageError);
  const auto voxel = [&](double side) {
    return message_of<plexway::UsageError>([&] {
      (void)plexway::openvdb::level_set_of(sphere.points, sphere.faces, {.voxel = side});
    });
  };
  CHECK_THAT(voxel(1e300), Contains("the voxel 1e+300 is larger than the whole surface"));
  CHECK_THAT(voxel(5), Contains("the voxel 5 is larger than the whole surface"));
  CHECK_THAT(voxel(1e-9), Contains("the voxel 1e-09 is too small"));
  CHECK_THAT(voxel(1e-300), Contains("the voxel 1e-300 is too small"));
  for (const double scale : {1e200, 1e-45}) {
    Shape beyond = geodesic_sphere(4);
    for (Point& p : beyond.points) p = scale * p;
    CHECK_THAT(refused(beyond, 0), Contains("beyond what a level set can hold"));
  }
}

TEST_CASE("the voxel that is chosen follows the surface's size and edges") {
  for (const double scale : {1e-3, 1.0, 1e4}) {
    Repair report;
    Shape shape = geodesic_sphere(10);
    for (Point& p : shape.points) p = scale * p + scale * Point{3, -100, 7};
    const auto level_set =
        plexway::openvdb::level_set_of(shape.points, shape.faces, {.report = &report});
    CHECK(report.voxel > scale * std::sqrt(12.0) / 129);
    CHECK(report.voxel < scale * std::sqrt(12.0) / 31);
    CHECK(level_set.voxel() == Approx(report.voxel));
    CHECK(enclosed(plexway::openvdb::surface_of(level_set)) ==
          Approx(scale * scale * scale * ball_volume(1)).epsilon(0.03));
  }
}

}  // namespace repair_test
