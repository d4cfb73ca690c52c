#include <array>
#include <catch2/catch.hpp>
#include <cmath>
#include <limits>
#include <random>
#include <set>
#include <vector>

#include <plexway/cloud/neighbours.hpp>
#include <plexway/cloud/point_cloud.hpp>
#include <plexway/common/distinct_points.hpp>
#include <plexway/error.hpp>

#include "complexes/test_clouds.hpp"

namespace point_cloud_test {

using plexway::CloudOptions;
using plexway::Index;
using plexway::Neighbours;
using plexway::PointCloud;

using Points = std::vector<std::array<double, 3>>;

namespace {

// Two flat unit squares, `gap` apart.
Points two_sheets(std::size_t each, double gap) {
  Points points = samples::plane_cloud(each, 1).points;
  for (std::array<double, 3> p : samples::plane_cloud(each, 2).points) {
    p[2] = gap;
    points.push_back(p);
  }
  return points;
}

}  // namespace

TEST_CASE("a closed cloud becomes a closed surface") {
  for (const double noise : {0.0, 0.003}) {
    const auto cloud = samples::sphere_cloud(2000, 3, noise);
    const PointCloud<double> sphere(cloud.points, test_clouds::near_pairs(cloud.points));
    const auto& summary = sphere.summary();
    CHECK(summary.triangles == 2 * 2000 - 4);  // Euler: V - E + F = 2
    CHECK(summary.boundary_points == 0);
    CHECK(summary.components == 1);
    CHECK(sphere.surface().summary().boundary_edges == 0);
    CHECK(sphere.surface().summary().non_manifold_edges == 0);
    CHECK(sphere.surface().summary().pinched_vertices == 0);
    CHECK((summary.noise > 0) == (noise > 0));
    CHECK(summary.mean_spacing == Approx(cloud.spacing()).epsilon(0.02));
  }
}

TEST_CASE("a regular grid, where four points lie on every circle, becomes one flat sheet") {
  Points points;
  for (int i = 0; i < 20; ++i)
    for (int j = 0; j < 15; ++j) points.push_back({0.1 * i, 0.1 * j, 5});
  const PointCloud<double> grid(points, test_clouds::near_pairs(points));
  CHECK(grid.summary().triangles == 2 * 19 * 14);
  CHECK(grid.summary().boundary_points == 2 * (19 + 14));
  CHECK(grid.surface().summary().non_manifold_edges == 0);
}

TEST_CASE("the boundary of a flat cloud is its outline") {
  const auto cloud = samples::wall_cloud(3000);
  const PointCloud<double> wall(cloud.points, test_clouds::near_pairs(cloud.points));
  // Every boundary point lies within three spacings of the outline.
  CHECK(wall.summary().components == 1);
  const auto& mesh = wall.surface();
  std::vector<std::array<double, 3>> place(mesh.vertex_count());
  for (Index v = 0; v < mesh.vertex_count(); ++v) place[mesh.inside_vertex(v)] = cloud.points[v];
  const Index sentinel = static_cast<Index>(mesh.face_count());
  std::size_t edges = 0;
  for (const auto& t : mesh.triangles().first(sentinel))
    for (std::size_t i = 0; i < 3; ++i) {
      if (t.across[i] >> plexway::detail::Across::face_shift != sentinel) continue;
      ++edges;
      const auto& p = place[t.corner[i]];
      const double outer = std::min({p[0], 1 - p[0], p[1], 1 - p[1]});
      const double dx = std::max({0.4 - p[0], p[0] - 0.6, 0.0}), dy = std::max(p[1] - 0.6, 0.0);
      CHECK(std::min(outer, std::hypot(dx, dy)) < 3 * cloud.spacing());
    }
  CHECK(edges > 100);
}

TEST_CASE("two close parallel sheets stay apart") {
  const std::size_t each = 1500;
  const double spacing = 1 / std::sqrt(double(each));
  for (const double gap : {1.5, 2.0, 3.0}) {
    const Points points = two_sheets(each, gap * spacing);
    const Neighbours near = test_clouds::near_pairs(points);
    const PointCloud<double> sheets(points, near);
    INFO("gap " << gap << " spacings");
    CHECK(sheets.summary().components == 2);
    CHECK(sheets.summary().component_sizes == std::vector<std::size_t>{each, each});
    // Whoever does not refuse neighbours by their normals gets one piece.
    CloudOptions all;
    all.max_normal_angle = 180;
    if (gap < 2) CHECK(PointCloud<double>(points, near, all).summary().components == 1);
  }
}

TEST_CASE("given normals keep sheets apart that are closer than the points") {
  const std::size_t each = 1500;
  const Points points = two_sheets(each, 0.3 / std::sqrt(double(each)));
  Points normals(points.size(), {0, 0, 2});
  for (std::size_t i = 0; i < each; ++i) normals[i] = {0, 0, -1};
  CloudOptions options;
  options.normals = normals;
  const Neighbours near = test_clouds::near_pairs(points);
  CHECK(PointCloud<double>(points, near, options).summary().components == 2);
}

TEST_CASE("normals that are not known follow those around") {
  const auto cloud = samples::sphere_cloud(1000);
  Points normals = cloud.points;  // of the unit sphere
  for (std::size_t i = 0; i < 300; ++i) normals[3 * i] = {0, 0, 0};
  normals[1] = {std::numeric_limits<double>::quiet_NaN(), 0, 0};
  CloudOptions options;
  options.normals = normals;
  const PointCloud<double> sphere(cloud.points, test_clouds::near_pairs(cloud.points), options);
  CHECK(sphere.summary().triangles == 2 * 1000 - 4);
  CHECK(sphere.summary().refused_pairs == 0);
}

TEST_CASE("duplicates collapse to one place") {
  auto points = samples::plane_cloud(500).points;
  for (std::size_t i = 0; i < 300; ++i) points.push_back(points[i / 3]);
  const PointCloud<double> cloud(points, test_clouds::near_pairs(points, 24));
  const auto& summary = cloud.summary();
  CHECK(summary.points == 800);
  CHECK(summary.distinct == 500);
  CHECK(summary.duplicates == 300);
  CHECK(summary.components == 1);
  CHECK(summary.largest_component == 800);
  CHECK(summary.isolated_points == 0);
  for (Index i = 0; i < 300; ++i) CHECK(cloud.of_point(500 + i) == i / 3);
  for (Index i = 0; i < 500; ++i) CHECK(cloud.of_point(i) == i);
  CHECK(cloud.surface().summary().unreferenced_vertices == 300);
}

TEST_CASE("components of a cloud are counted") {
  Points points = samples::plane_cloud(400, 1).points;
  for (std::array<double, 3> p : samples::plane_cloud(300, 2).points) {
    p[0] += 5;
    points.push_back(p);
  }
  points.push_back({100, 0, 0});
  Neighbours near = test_clouds::near_pairs(points, 12);
  near.of.resize(near.begin[700]);  // the last one is left without neighbours
  for (Index i = 0; i < 700; ++i)
    for (Index k = near.begin[i]; k < near.begin[i + 1]; ++k)
      if (near.of[k] == 700) near.of[k] = near.of[near.begin[i]];
  near.begin[701] = near.begin[700];
  const PointCloud<float> cloud(points, near);
  CHECK(cloud.summary().component_sizes == std::vector<std::size_t>{400, 300, 1});
  CHECK(cloud.summary().components == 3);
  CHECK(cloud.summary().largest_component == 400);
  CHECK(cloud.summary().isolated_points == 1);
}

TEST_CASE("the cloud does not depend on the number of threads") {
  const auto made = samples::sphere_cloud(4000, 2, 0.002);
  const Neighbours near = test_clouds::near_pairs(made.points);
  CloudOptions one, four;
  one.threads = 1;
  four.threads = 4;
  const PointCloud<float> a(made.points, near, one), b(made.points, near, four);
  REQUIRE(a.surface().face_count() == b.surface().face_count());
  for (std::size_t f = 0; f < a.surface().face_count(); ++f) {
    const auto &s = a.surface().triangles()[f], &t = b.surface().triangles()[f];
    for (std::size_t i = 0; i < 3; ++i) {
      CHECK(s.across[i] == t.across[i]);
      CHECK(s.corner[i] == t.corner[i]);
      CHECK(s.length[i] == t.length[i]);
      CHECK(s.signed_sine[i] == t.signed_sine[i]);
    }
  }
}

TEST_CASE("building a cloud tells how far it is and stops when asked") {
  const auto made = samples::plane_cloud(3000);
  const Neighbours near = test_clouds::near_pairs(made.points);
  CloudOptions options;
  double last = 0;
  options.progress = [&](double share) {
    CHECK(share >= last);
    last = share;
    return true;
  };
  const PointCloud<float> cloud(made.points, near, options);
  CHECK(last == 1);
  options.progress = [](double share) { return share < 0.3; };
  CHECK_THROWS_AS(PointCloud<float>(made.points, near, options), plexway::Cancelled);
}

TEST_CASE("clouds that make no sense are refused by name") {
  const Points three = {{0, 0, 0}, {1, 0, 0}, {0, std::numeric_limits<double>::infinity(), 0}};
  const Neighbours near = {{0, 1, 2, 3}, {1, 0, 0}};
  CHECK_THROWS_WITH(PointCloud<float>(three, near), Catch::Contains("point 2"));
  CHECK_THROWS_AS(PointCloud<float>(three, near), plexway::InputError);
  CHECK_THROWS_WITH(PointCloud<float>(Points{}, Neighbours{}), Catch::Contains("no points"));
  const Points two = {{0, 0, 0}, {1, 0, 0}};
  CHECK_THROWS_WITH(PointCloud<float>(two, near), Catch::Contains("neighbours of 3"));
  CHECK_THROWS_AS(PointCloud<float>(two, Neighbours{{0, 1, 2}, {1, 5}}), plexway::InputError);
  CloudOptions options;
  const Points one_normal = {{0, 0, 1}};
  options.normals = one_normal;
  CHECK_THROWS_AS(PointCloud<float>(two, Neighbours{{0, 1, 2}, {1, 0}}, options),
                  plexway::InputError);
  options = {};
  options.max_normal_angle = 0;
  CHECK_THROWS_AS(PointCloud<float>(two, Neighbours{{0, 1, 2}, {1, 0}}, options),
                  plexway::UsageError);
}

// Lattices of points that something rounded: whether four points lie on one circle is then a matter
// of noise, and all four must decide alike.

TEST_CASE("a turned lattice becomes one flat sheet whatever its points are rounded to") {
  using plexway::PointCloud;
  constexpr int side = 24;
  for (const double noise : {0., 1e-9, 1e-7, 3e-7, 1e-6, 3e-6, 1e-5, 1e-4, 3e-4, 1e-3})
    for (unsigned seed = 0; seed < 3; ++seed) {
      std::mt19937 random(seed);
      std::uniform_real_distribution<double> one(-1, 1);
      const double turn = 3 * one(random), tilt = one(random);
      std::vector<std::array<double, 3>> points;
      for (int j = 0; j < side; ++j)
        for (int i = 0; i < side; ++i) {
          const double x = i + noise * one(random), y = j + noise * one(random),
                       z = noise * one(random);
          const double u = std::cos(turn) * x - std::sin(turn) * y,
                       v = std::sin(turn) * x + std::cos(turn) * y;
          points.push_back({u, std::cos(tilt) * v - std::sin(tilt) * z,
                            std::sin(tilt) * v + std::cos(tilt) * z});
        }
      const PointCloud<double> cloud(points, test_clouds::near_pairs(points));
      CAPTURE(noise, seed);
      // Nothing is missing: not a triangle inside, nor one at the rim, where noise may add some.
      CHECK(cloud.summary().triangles >= 2 * (side - 1) * (side - 1));
      CHECK(cloud.surface().summary().components == 1);
      CHECK(cloud.surface().summary().boundary_edges <= 4 * (side - 1));
      CHECK(cloud.surface().summary().boundary_edges >= 4 * (side - 1) - 8);
    }
}

TEST_CASE("symmetric closure adds who has a point but not the other way around") {
  // 0 has 1, 1 has 2, 2 has 0 and 1.
  const Neighbours closed = plexway::symmetric_closure(Neighbours{{0, 1, 2, 4}, {1, 2, 0, 1}});
  CHECK(closed.begin == std::vector<Index>{0, 2, 4, 6});
  CHECK(closed.of == std::vector<Index>{1, 2, 2, 0, 0, 1});
}

TEST_CASE("symmetric closure with places has rows nearest first") {
  const std::vector<std::array<double, 3>> line = {{0, 0, 0}, {1, 0, 0}, {3, 0, 0}, {3.5, 0, 0}};
  const Neighbours nearest = test_clouds::by_brute_force(line, 1);
  CHECK(nearest.of == std::vector<Index>{1, 0, 3, 2});
  const Neighbours closed =
      plexway::symmetric_closure(Neighbours{{0, 1, 1, 3, 4}, {2, 0, 3, 1}}, line);
  CHECK(closed.of == std::vector<Index>{2, 3, 3, 0, 2, 1});
}

TEST_CASE("symmetric closure of a random graph holds all pairs and no others") {
  const auto cloud = samples::plane_cloud(300);
  const Neighbours nearest = test_clouds::by_brute_force(cloud.points, 5);
  const Neighbours closed = plexway::symmetric_closure(nearest, cloud.points);
  std::set<std::pair<Index, Index>> wanted, found;
  for (Index i = 0; i < 300; ++i) {
    for (const Index j : nearest.around(i)) wanted.insert({i, j}), wanted.insert({j, i});
    for (const Index j : closed.around(i)) CHECK(found.insert({i, j}).second);
  }
  CHECK(found == wanted);
}

TEST_CASE("neighbour lists that make no sense are refused by name") {
  using Catch::Contains;
  CHECK_NOTHROW(plexway::check(Neighbours{}));
  CHECK_NOTHROW(plexway::check(Neighbours{{0}, {}}));
  CHECK_THROWS_WITH(plexway::check(Neighbours{{0, 1, 2}, {1, 7}}),
                    Contains("point 1: neighbour 7"));
  CHECK_THROWS_WITH(plexway::check(Neighbours{{0, 1, 2}, {0, 0}}),
                    Contains("point 0 is in its own"));
  CHECK_THROWS_WITH(plexway::check(Neighbours{{0, 2, 1, 2}, {1, 2}}), Contains("point 1"));
  CHECK_THROWS_AS(plexway::check(Neighbours{{0, 1}, {}}), plexway::InputError);
  CHECK_THROWS_AS(plexway::symmetric_closure(Neighbours{{0, 1, 2}, {1, 0}}, {}),
                  plexway::InputError);
}

TEST_CASE("distinct points name the first at each place") {
  const std::vector<std::array<double, 3>> points = {
      {1, 2, 3}, {0, 0, 0}, {1, 2, 3}, {-0.0, 0, 0}, {1, 2, 3.0000000001}, {1, 2, 3}};
  const auto distinct = plexway::distinct_points(points);
  CHECK(distinct.first == std::vector<Index>{0, 1, 0, 1, 4, 0});
  CHECK(std::set<Index>(distinct.order.begin(), distinct.order.end()) == std::set<Index>{0, 1, 4});
  CHECK(plexway::distinct_points({}).order.empty());
}

TEST_CASE("distinct points agree with a search through all pairs") {
  // Few places, far apart and, by an outlier, all in one cell of the curve.
  auto points = samples::sphere_cloud(200).points;
  for (std::size_t i = 0; i < 100; ++i) points.push_back(points[(7 * i) % 50]);
  for (int outlier = 0; outlier < 2; ++outlier) {
    const auto distinct = plexway::distinct_points(points);
    for (Index i = 0; i < points.size(); ++i) {
      Index first = 0;
      while (points[first] != points[i]) ++first;
      CHECK(distinct.first[i] == first);
    }
    points.push_back({1e9, 0, 0});
  }
}

TEST_CASE("distinct points refuse what is not finite by name") {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const std::vector<std::array<double, 3>> points = {{0, 0, 0}, {1, nan, 0}};
  CHECK_THROWS_WITH(plexway::distinct_points(points), Catch::Contains("point 1"));
  CHECK_THROWS_AS(plexway::distinct_points(points), plexway::InputError);
}

}  // namespace point_cloud_test
