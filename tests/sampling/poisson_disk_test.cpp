#include <plexway/sampling/poisson_disk.hpp>

#include <catch2/catch.hpp>
#include <set>

#include <plexway/error.hpp>

#include "complexes/test_solids.hpp"
#include "data/solid_shapes.hpp"
#include "sampling/sampling_testing.hpp"

namespace plexway::poisson_disk_test {

using namespace sampling_testing;

namespace {

template <class Real = float>
std::vector<Point> throw_on(const samples::Shape& shape, const PoissonOptions& options) {
  const TriangleMesh<Real> mesh(shape.points, shape.faces);
  const PoissonDisks disks = poisson_disks(Serial{}, mesh, options);
  CHECK(disks.maximal);
  return positions(disks.darts, shape.points, shape.faces);
}

Point noise_in_square(samples::Noise& noise) { return {(noise() + 1) / 2, (noise() + 1) / 2, 0}; }

samples::Shape unit_cube() {  // of six tetrahedra
  samples::Shape cube;
  for (int i = 0; i < 8; ++i)
    cube.add(
        {static_cast<double>(i & 1), static_cast<double>(i >> 1 & 1), static_cast<double>(i >> 2)});
  cube.tets = {{0, 1, 3, 7}, {0, 3, 2, 7}, {0, 2, 6, 7}, {0, 6, 4, 7}, {0, 4, 5, 7}, {0, 5, 1, 7}};
  return cube;
}

double farthest_in_cube(const std::vector<Point>& darts) {
  samples::Noise noise(14);
  double farthest = 0;
  for (int n = 0; n < 20000; ++n)
    farthest = std::max(farthest, nearest({(noise() + 1) / 2, (noise() + 1) / 2, (noise() + 1) / 2},
                                          darts, euclid));
  return farthest;
}

template <class Distance>
double farthest_in(const samples::Shape& solid, const std::vector<Point>& darts,
                   Distance distance) {
  samples::Noise noise(16);
  double farthest = 0;
  for (int n = 0; n < 20000; ++n) {
    const auto& tet = solid.tets[static_cast<std::size_t>(n) % solid.tets.size()];
    double w[4], sum = 0;
    for (double& x : w) sum += x = noise() + 1;
    Point at = {0, 0, 0};
    for (std::size_t i = 0; i < 4; ++i)
      for (std::size_t k = 0; k < 3; ++k) at[k] += w[i] / sum * solid.points[tet[i]][k];
    farthest = std::max(farthest, nearest(at, darts, distance));
  }
  return farthest;
}

}  // namespace

TEST_CASE("darts on a square are neither nearer nor farther than the radius") {
  for (const double radius : {0.05, 0.08, 0.3}) {
    const auto darts = throw_on(square(60), {.radius = radius, .seed = 3});
    INFO("radius " << radius << ", " << darts.size() << " darts");
    CHECK(least_distance(darts, euclid) >= radius * (1 - 1e-3));
    samples::Noise noise(11);
    double farthest = 0;
    for (int n = 0; n < 20000; ++n)
      farthest = std::max(farthest, nearest(noise_in_square(noise), darts, euclid));
    CHECK(farthest <= radius * (1 + 1e-5));
  }
}

TEST_CASE("triangles larger than the radius are covered all over") {
  samples::Shape shape;
  for (const Point& p : {Point{0, 0, 0}, Point{1, 0, 0}, Point{1, 1, 0}, Point{0, 1, 0}})
    shape.add(p);
  shape.faces = {{0, 1, 2}, {0, 2, 3}};
  const auto darts = throw_on(shape, {.radius = 0.06});
  CHECK(darts.size() > 150);
  CHECK(least_distance(darts, euclid) >= 0.06 * (1 - 1e-3));
  samples::Noise noise(12);
  for (int n = 0; n < 20000; ++n)
    if (!(nearest(noise_in_square(noise), darts, euclid) <= 0.06 * (1 + 1e-5))) {
      FAIL_CHECK("a point is not covered");
      break;
    }
}

TEST_CASE("darts on a sphere are neither nearer nor farther than the radius") {
  const samples::Shape sphere = samples::geodesic_sphere(60);
  const auto darts = throw_on(sphere, {.radius = 0.2, .seed = 5});
  CHECK(least_distance(darts, great_circle) >= 0.2 * (1 - 1e-3));
  samples::Noise noise(13);
  double farthest = 0;
  for (int n = 0; n < 20000; ++n)
    farthest = std::max(farthest, nearest({noise(), noise(), noise()}, darts, great_circle));
  CHECK(farthest <= 0.2 * (1 + 2e-4));  // the facets are a little inside
}

TEST_CASE("darts in a cube are neither nearer nor farther than the radius") {
  const samples::Shape cube = unit_cube();
  const TetMesh<float> mesh(cube.points, cube.tets);
  const PoissonDisks disks = poisson_disks(Serial{}, mesh, {.radius = 0.25});
  const auto darts = positions(disks.darts, cube.points, cube.tets);
  INFO(darts.size() << " darts");
  CHECK(least_distance(darts, euclid) >= 0.25 * (1 - 1e-3));
  CHECK(farthest_in_cube(darts) <= 0.25 * (1 + 1e-5));
}

TEST_CASE("darts in a bent solid keep apart around the bend") {
  const samples::Shape elbow = samples::elbow_solid();
  const TetMesh<double> mesh(elbow.points, elbow.tets);
  constexpr double radius = 0.35;
  const PoissonDisks disks = poisson_disks(Serial{}, mesh, {.radius = radius});
  const auto darts = positions(disks.darts, elbow.points, elbow.tets);
  INFO(darts.size() << " darts");
  CHECK(least_distance(darts, inside_elbow) >= radius * (1 - 1e-3));
  CHECK(farthest_in(elbow, darts, inside_elbow) <= radius * (1 + 1e-5));
}

TEST_CASE("a solid done box by box is covered as one done at once") {
  const samples::Shape cube = unit_cube();
  const TetMesh<float> mesh(cube.points, cube.tets);
  constexpr double radius = 0.22;
  const PoissonDisks whole = poisson_disks(Serial{}, mesh, {.radius = radius});
  const PoissonDisks disks = poisson_disks(Serial{}, mesh, {.radius = radius, .at_once = 26000});
  const auto darts = positions(disks.darts, cube.points, cube.tets);
  INFO(darts.size() << " darts, at once " << whole.darts.size());
  CHECK(disks.thrown != whole.thrown);  // it was done in boxes
  // Boxes hardly wider than the radius fill more densely from one to the next.
  CHECK(static_cast<double>(darts.size()) ==
        Approx(static_cast<double>(whole.darts.size())).epsilon(0.15));
  CHECK(least_distance(darts, euclid) >= radius * (1 - 1e-3));
  CHECK(farthest_in_cube(darts) <= radius * (1 + 1e-5));
}

TEST_CASE("boxes of a bent solid are told from what is behind a corner") {
  const samples::Shape elbow = samples::elbow_solid();
  const TetMesh<double> mesh(elbow.points, elbow.tets);
  constexpr double radius = 0.35;
  const PoissonDisks disks = poisson_disks(
      Serial{}, mesh, {.radius = radius, .order = DartOrder::simplices, .at_once = 20000});
  const auto darts = positions(disks.darts, elbow.points, elbow.tets);
  CHECK(least_distance(darts, inside_elbow) >= radius * (1 - 1e-3));
  CHECK(farthest_in(elbow, darts, inside_elbow) <= radius * (1 + 1e-5));
}

TEST_CASE("boxes agree with a spacing, and with darts at vertices") {
  const testing::Solid cube = testing::solid_cube(2);
  const auto radius_at = [](const Point& p) { return 0.3 * (0.7 + p[0] / 2); };
  std::vector<double> spacing;
  for (const Point& p : cube.positions) spacing.push_back(0.7 + p[0] / 2);
  const TetMesh<double> mesh(cube.positions, cube.tets);
  const PoissonDisks disks =
      poisson_disks(Serial{}, mesh, {.radius = 0.3, .spacing = spacing, .at_once = 30000});
  const auto darts = positions(disks.darts, cube.positions, cube.tets);
  double nearest_pair = 2;
  for (std::size_t i = 0; i < darts.size(); ++i)
    for (std::size_t j = 0; j < i; ++j)
      nearest_pair = std::min(nearest_pair, euclid(darts[i], darts[j]) / radius_at(darts[j]));
  CHECK(nearest_pair >= 1 - 1e-3);
  samples::Noise noise(18);
  double farthest = 0;
  for (int n = 0; n < 10000; ++n) {
    const Point at = {(noise() + 1) / 2, (noise() + 1) / 2, (noise() + 1) / 2};
    double nearest = 2;
    for (const Point& dart : darts) nearest = std::min(nearest, euclid(at, dart) / radius_at(dart));
    farthest = std::max(farthest, nearest);
  }
  CHECK(farthest <= 1 + 1e-5);

  const PoissonDisks at_vertices =
      poisson_disks(Serial{}, mesh, {.radius = 0.6, .at_vertices = true, .at_once = 6000});
  std::set<Index> chosen;
  std::vector<Point> there;
  for (const PointSource& dart : at_vertices.darts) {
    chosen.insert(dart.vertex);
    there.push_back(cube.positions[dart.vertex]);
  }
  CHECK(chosen.size() == at_vertices.darts.size());
  CHECK(least_distance(there, euclid) >= 0.6 * (1 - 1e-3));
  double apart = 0;
  for (const Point& p : cube.positions) apart = std::max(apart, nearest(p, there, euclid));
  CHECK(apart <= 0.6 * (1 + 1e-5));
}

TEST_CASE("a surface done box by box is covered as one done at once") {
  const samples::Shape sphere = samples::geodesic_sphere(24);
  const TriangleMesh<float> mesh(sphere.points, sphere.faces);
  constexpr double radius = 0.05;
  const PoissonDisks whole = poisson_disks(Serial{}, mesh, {.radius = radius});
  const PoissonDisks disks = poisson_disks(Serial{}, mesh, {.radius = radius, .at_once = 30000});
  const auto darts = positions(disks.darts, sphere.points, sphere.faces);
  INFO(darts.size() << " darts, at once " << whole.darts.size());
  CHECK(disks.thrown != whole.thrown);  // it was done in boxes
  CHECK(static_cast<double>(darts.size()) ==
        Approx(static_cast<double>(whole.darts.size())).epsilon(0.05));
  CHECK(least_distance(darts, great_circle) >= radius * (1 - 1e-3));
  samples::Noise noise(14);
  double farthest = 0;
  for (int n = 0; n < 5000; ++n)
    farthest = std::max(farthest, nearest({noise(), noise(), noise()}, darts, great_circle));
  CHECK(farthest <= radius * (1 + 2e-4));
}

TEST_CASE("boxes of a surface are told from what is near in space alone") {
  // Two sheets much nearer than the radius, joined nowhere, and a vertex of no triangle.
  samples::Shape sheets = square(2);
  const Index corners = static_cast<Index>(sheets.points.size());
  const std::size_t faces = sheets.faces.size();
  for (Index v = 0; v < corners; ++v) {
    const Point p = sheets.points[v];
    sheets.points.push_back({p[0], p[1], 0.01});
  }
  for (std::size_t f = 0; f < faces; ++f) {
    auto face = sheets.faces[f];
    for (Index& v : face) v += corners;
    sheets.faces.push_back(face);
  }
  sheets.points.push_back({0.5, 0.5, 3});
  constexpr double radius = 0.06;
  const TriangleMesh<double> mesh(sheets.points, sheets.faces);
  const PoissonDisks disks = poisson_disks(Serial{}, mesh, {.radius = radius, .at_once = 4000});
  const auto all = positions(disks.darts, sheets.points, sheets.faces);
  for (const double height : {0., 0.01}) {
    std::vector<Point> darts;
    for (const Point& p : all)
      if (p[2] == Approx(height).margin(1e-9)) darts.push_back(p);
    INFO(darts.size() << " darts at " << height);
    CHECK(least_distance(darts, euclid) >= radius * (1 - 1e-3));
    samples::Noise noise(15);
    double farthest = 0;
    for (int n = 0; n < 5000; ++n)
      farthest = std::max(farthest,
                          nearest({(noise() + 1) / 2, (noise() + 1) / 2, height}, darts, euclid));
    CHECK(farthest <= radius * (1 + 1e-5));
  }
  const PoissonDisks at_vertices =
      poisson_disks(Serial{}, mesh, {.radius = radius, .at_vertices = true, .at_once = 4000});
  CHECK(at_vertices.darts.size() == sheets.points.size());
}

TEST_CASE("a seed makes the same darts again and another seed other ones") {
  const samples::Shape shape = square(20);
  const auto one = throw_on<double>(shape, {.radius = 0.1, .seed = 1});
  CHECK(one == throw_on<double>(shape, {.radius = 0.1, .seed = 1}));
  CHECK(one != throw_on<double>(shape, {.radius = 0.1, .seed = 2}));
  const auto by_face = throw_on<double>(shape, {.radius = 0.1, .order = DartOrder::simplices});
  CHECK(by_face != one);
  CHECK(least_distance(by_face, euclid) >= 0.1 * (1 - 1e-3));
}

TEST_CASE("as many darts as asked for") {
  const samples::Shape shape = square(40);
  const TriangleMesh<float> mesh(shape.points, shape.faces);
  for (const std::size_t count : {1u, 7u, 100u, 500u}) {
    const PoissonDisks disks = poisson_disks(Serial{}, mesh, {.count = count});
    CHECK(disks.darts.size() == count);
    const auto darts = positions(disks.darts, shape.points, shape.faces);
    CHECK(least_distance(darts, euclid) >= disks.radius * (1 - 1e-3));
  }
}

TEST_CASE("darts at vertices cover the vertices") {
  const samples::Shape shape = square(40);
  for (const double radius : {0.01, 0.033, 0.1}) {  // an edge has about 0.025
    const TriangleMesh<float> mesh(shape.points, shape.faces);
    const PoissonDisks disks =
        poisson_disks(Serial{}, mesh, {.radius = radius, .at_vertices = true});
    std::set<Index> chosen;
    for (const PointSource& dart : disks.darts) chosen.insert(dart.vertex);
    CHECK(chosen.size() == disks.darts.size());
    CHECK(*chosen.rbegin() < shape.points.size());
    const auto darts = positions(disks.darts, shape.points, shape.faces);
    INFO("radius " << radius << ", " << darts.size() << " darts");
    CHECK(least_distance(darts, euclid) >= radius * (1 - 1e-3));
    double farthest = 0;
    for (const Point& p : shape.points) farthest = std::max(farthest, nearest(p, darts, euclid));
    CHECK(farthest <= radius * (1 + 1e-5));
  }
}

TEST_CASE("a spacing makes darts denser where it is smaller") {
  const samples::Shape shape = square(60);
  const auto radius_at = [](const Point& p) { return 0.06 * (0.4 + p[0]); };
  std::vector<double> spacing;
  for (const Point& p : shape.points) spacing.push_back(0.4 + p[0]);
  const TriangleMesh<double> mesh(shape.points, shape.faces);
  const PoissonDisks disks = poisson_disks(Serial{}, mesh, {.radius = 0.06, .spacing = spacing});
  const auto darts = positions(disks.darts, shape.points, shape.faces);
  for (std::size_t i = 0; i < darts.size(); ++i)
    for (std::size_t j = 0; j < i; ++j)
      if (!(euclid(darts[i], darts[j]) >= radius_at(darts[j]) * (1 - 1e-3)))
        FAIL_CHECK("darts " << j << " and " << i << " are too near");
  samples::Noise noise(15);
  for (int n = 0; n < 10000; ++n) {
    const Point at = noise_in_square(noise);
    bool covered = false;
    for (const Point& dart : darts)
      covered = covered || euclid(at, dart) <= radius_at(dart) * (1 + 1e-5);
    if (!covered) FAIL_CHECK("a point is not covered");
  }
}

TEST_CASE("darts keep apart along the surface and not through space") {
  // Two sheets, 0.01 apart, joined far away: a strip folded over.
  samples::Shape shape;
  const Index n = 60, m = 20;
  for (Index i = 0; i <= 2 * n; ++i)
    for (Index j = 0; j <= m; ++j) {
      const double s = static_cast<double>(i) / n;
      const double x = s <= 1 ? s : 2 - s;
      shape.add({x, static_cast<double>(j) / m / 3, s <= 1 ? 0. : 0.01});
    }
  for (Index i = 0; i < 2 * n; ++i)
    for (Index j = 0; j < m; ++j) {
      const Index a = i * (m + 1) + j;
      shape.faces.push_back({a, a + m + 1, a + m + 2});
      shape.faces.push_back({a, a + m + 2, a + 1});
    }
  const auto darts = throw_on(shape, {.radius = 0.12});
  CHECK(least_distance(darts, euclid) < 0.1);
  // Unfolded, but for the fold itself.
  const auto unfolded = [](const Point& a, const Point& b) {
    const double u = a[2] > 0.005 ? 2 - a[0] : a[0], v = b[2] > 0.005 ? 2 - b[0] : b[0];
    return std::hypot(u - v, a[1] - b[1]);
  };
  CHECK(least_distance(darts, unfolded) >= 0.12 * (1 - 1e-3) - 0.01);
}

TEST_CASE("darts are refused where options make no sense") {
  const samples::Shape shape = square(4);
  const TriangleMesh<float> mesh(shape.points, shape.faces);
  CHECK_THROWS_AS(poisson_disks(Serial{}, mesh, {}), UsageError);
  CHECK_THROWS_AS(poisson_disks(Serial{}, mesh, {.radius = 1, .count = 3}), UsageError);
  CHECK_THROWS_AS(poisson_disks(Serial{}, mesh, {.radius = -1}), UsageError);
  CHECK_THROWS_AS(poisson_disks(Serial{}, mesh, {.count = 100, .at_vertices = true}), UsageError);
  const std::vector<double> few = {1, 2};
  CHECK_THROWS_AS(poisson_disks(Serial{}, mesh, {.radius = 1, .spacing = few}), UsageError);
  PoissonOptions cancelled{.radius = 0.1};
  cancelled.progress = [](double) { return false; };
  CHECK_THROWS_AS(poisson_disks(Serial{}, mesh, cancelled), Cancelled);
  const std::vector<std::array<Index, 4>> tet = {{0, 1, 2, 3}};
  const std::vector<std::array<double, 6>> lengths = {{1, 1, 1, 1, 1, 1}};
  CHECK_THROWS_AS(poisson_disks(Serial{}, TetMesh<float>(4, tet, lengths), {.radius = 1}),
                  UsageError);
}

TEST_CASE("radii beyond the domain end with one dart, however large") {
  samples::Shape shape = square(4);
  const auto first = static_cast<std::uint32_t>(shape.points.size());
  for (const Point& p : square(3).points) shape.add({p[0] + 5, p[1], p[2]});
  for (auto face : square(3).faces) {
    for (auto& v : face) v += first;
    shape.faces.push_back(face);
  }
  for (const double radius : {20., 1e12, 1e40, 1e300}) {
    INFO(radius);
    CHECK(throw_on(shape, {.radius = radius}).size() == 2);  // one in each part
    CHECK(throw_on<double>(shape, {.radius = radius}).size() == 2);
  }
}

TEST_CASE("radii too small for memory, or too different for the numbers, are refused at once") {
  const samples::Shape shape = square(8);
  const TriangleMesh<float> mesh(shape.points, shape.faces);
  CHECK_THROWS_WITH(poisson_disks(Serial{}, mesh, {.radius = 1e-7}),
                    Catch::Contains("is too small for this domain") && Catch::Contains("choose"));
  CHECK_THROWS_AS(poisson_disks(Serial{}, mesh, {.radius = 1e-7}), UsageError);
  CHECK_THROWS_AS(poisson_disks(Serial{}, mesh, {.radius = 1e-200}), UsageError);
  samples::Shape box = samples::elbow_solid();
  const TetMesh<float> solid(box.points, box.tets);
  CHECK_THROWS_AS(poisson_disks(Serial{}, solid, {.radius = 1e-6}), UsageError);

  std::vector<double> spacing(shape.points.size(), 1);
  spacing[40] = 1e308;
  CHECK_THROWS_AS(poisson_disks(Serial{}, mesh, {.radius = 0.2, .spacing = spacing}),
                  PrecisionError);
  const TriangleMesh<double> twice(shape.points, shape.faces);
  CHECK_THROWS_AS(poisson_disks(Serial{}, twice, {.radius = 0.2, .spacing = spacing}),
                  PrecisionError);
  spacing[40] = 1e5;
  CHECK_THROWS_WITH(poisson_disks(Serial{}, mesh, {.radius = 0.2, .spacing = spacing}),
                    Catch::Contains("use double"));
  CHECK(poisson_disks(Serial{}, twice, {.radius = 0.2, .spacing = spacing}).darts.size() > 0);
}

}  // namespace plexway::poisson_disk_test
