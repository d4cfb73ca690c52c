#include <plexway/flann/neighbours.hpp>

#include <catch2/catch.hpp>
#include <cmath>
#include <limits>

#include <plexway/error.hpp>

#include "complexes/test_clouds.hpp"

namespace neighbours_test {

using plexway::Index;
using plexway::Neighbours;
using plexway::flann::NeighbourOptions;
using Points = std::vector<std::array<double, 3>>;

namespace {

Points random_points(std::size_t n, std::uint64_t seed) {
  samples::Uniform u(seed);
  Points points(n);
  for (auto& p : points) p = {u(), u(), u()};
  return points;
}

Points grid() {  // many neighbours are equally near
  Points points;
  for (int i = 0; i < 9; ++i)
    for (int j = 0; j < 9; ++j)
      for (int k = 0; k < 4; ++k) points.push_back({double(i), double(j), double(k)});
  return points;
}

bool same(const Neighbours& a, const Neighbours& b) { return a.begin == b.begin && a.of == b.of; }

}  // namespace

TEST_CASE("nearest neighbours are those that a search through all finds") {
  for (const Points& points : {random_points(700, 1), samples::swiss_cloud(700).points, grid()})
    for (const std::size_t k : {1u, 5u, 16u, 40u}) {
      const Neighbours wanted = test_clouds::by_brute_force(points, k);
      CHECK(same(plexway::flann::neighbours(points, {.k = k, .symmetric = false}), wanted));
      CHECK(same(plexway::flann::neighbours(points, {.k = k}),
                 plexway::symmetric_closure(wanted, points)));
    }
}

TEST_CASE("neighbours within a radius, with and without a cap") {
  for (const Points& points : {random_points(500, 2), grid()}) {
    const double radius = points[0][0] == 0 ? 2 : 0.21;  // on the grid some are just that far
    const Neighbours all = test_clouds::by_brute_force(points, points.size());
    Neighbours within = {{0}, {}}, capped = {{0}, {}};
    for (Index i = 0; i < points.size(); ++i) {
      for (const Index j : all.around(i)) {
        if (test_clouds::squared(points[i], points[j]) > radius * radius) break;
        within.of.push_back(j);
        if (capped.of.size() - capped.begin.back() < 6) capped.of.push_back(j);
      }
      within.begin.push_back(static_cast<Index>(within.of.size()));
      capped.begin.push_back(static_cast<Index>(capped.of.size()));
    }
    CHECK(same(plexway::flann::neighbours(points, {.k = 0, .radius = radius}), within));
    CHECK(same(plexway::flann::neighbours(points, {.k = 6, .radius = radius, .symmetric = false}),
               capped));
    CHECK(same(plexway::flann::neighbours(points, {.k = 6, .radius = radius}),
               plexway::symmetric_closure(capped, points)));
  }
}

TEST_CASE("more neighbours than there are points are all others") {
  const Points points = random_points(12, 3);
  const Neighbours wanted = test_clouds::by_brute_force(points, 11);
  for (const std::size_t k : {11u, 12u, 1000u})
    CHECK(same(plexway::flann::neighbours(points, {.k = k}), wanted));
  CHECK(plexway::flann::neighbours(Points{}).point_count() == 0);
  CHECK(plexway::flann::neighbours(Points{{1, 2, 3}}).of.empty());
  CHECK(plexway::flann::neighbours(Points{{1, 2, 3}, {3, 2, 1}}).of == std::vector<Index>{1, 0});
}

TEST_CASE("equal points do not hide the others") {
  Points points = random_points(100, 4);
  const Neighbours plain = plexway::flann::neighbours(points, {.k = 4});
  for (int copy = 0; copy < 30; ++copy) points.push_back(points[7]);
  const Neighbours found = plexway::flann::neighbours(points, {.k = 4});
  for (Index i = 0; i < 100; ++i) {
    std::vector<Index> row(found.around(i).begin(), found.around(i).end());
    if (i == 7) {
      for (Index twin = 0; twin < 30; ++twin) CHECK(row[twin] == 100 + twin);
      row.erase(row.begin(), row.begin() + 30);
    }
    CHECK(row == std::vector<Index>(plain.around(i).begin(), plain.around(i).end()));
  }
  for (Index twin = 100; twin < 130; ++twin) {
    REQUIRE(found.around(twin).size() == 1);
    CHECK(found.around(twin)[0] == 7);
  }
  const Points one_place(40, {5, 5, 5});
  CHECK(plexway::flann::neighbours(one_place).around(0).size() == 39);
}

TEST_CASE("neighbours do not depend on threads, order, scale or place") {
  const Points points = random_points(3000, 5);
  const Neighbours wanted = plexway::flann::neighbours(points, {.threads = 1});
  CHECK(same(plexway::flann::neighbours(points, {.threads = 4}), wanted));
  for (const double scale : {0x1p-500, 0x1p500}) {
    Points scaled = points;
    for (auto& p : scaled)
      for (double& x : p) x *= scale;
    CHECK(same(plexway::flann::neighbours(scaled), wanted));
  }
  const Points reversed(points.rbegin(), points.rend());
  const Neighbours found = plexway::flann::neighbours(reversed);
  const Index last = 2999;
  for (Index i = 0; i < 3000; ++i) {
    std::vector<Index> row;
    for (const Index j : found.around(last - i)) row.push_back(last - j);
    CHECK(row == std::vector<Index>(wanted.around(i).begin(), wanted.around(i).end()));
  }
}

TEST_CASE("a search tells how far it is and stops when asked") {
  const Points points = random_points(5000, 6);
  double last = 0;
  NeighbourOptions options;
  options.progress = [&](double share) {
    last = share;
    return true;
  };
  CHECK_NOTHROW(plexway::flann::neighbours(points, options));
  CHECK(last == 1);
  options.progress = [](double) { return false; };
  CHECK_THROWS_AS(plexway::flann::neighbours(points, options), plexway::Cancelled);
}

TEST_CASE("searches that make no sense are refused") {
  Points points = random_points(10, 7);
  CHECK_THROWS_AS(plexway::flann::neighbours(points, {.k = 0}), plexway::UsageError);
  CHECK_THROWS_AS(plexway::flann::neighbours(points, {.radius = 0}), plexway::UsageError);
  CHECK_THROWS_AS(plexway::flann::neighbours(points, {.radius = std::nan("")}),
                  plexway::UsageError);
  points[6][1] = std::numeric_limits<double>::quiet_NaN();
  CHECK_THROWS_WITH(plexway::flann::neighbours(points), Catch::Contains("point 6"));
  CHECK_THROWS_AS(plexway::flann::neighbours(points), plexway::InputError);
  CHECK_THROWS_AS(plexway::flann::connecting_k(points), plexway::InputError);
}

TEST_CASE("the smallest k that connects a cloud") {
  // Pairs along a line: a and b a unit apart, pairs 3 apart. One neighbour is the partner; with
  // two, the next pair's nearer point is in the list.
  Points pairs;
  for (int i = 0; i < 20; ++i) {
    pairs.push_back({4.0 * i, 0, 0});
    pairs.push_back({4.0 * i + 1, 0, 0});
  }
  CHECK(plexway::flann::connecting_k(pairs) == 2u);
  // Two clusters of m: everyone has m - 1 others of its own nearer.
  for (const std::size_t m : {5u, 16u, 17u, 40u}) {
    Points clusters = random_points(2 * m, 8);
    for (std::size_t i = 0; i < m; ++i) clusters[i][0] += 1000;
    CHECK(plexway::flann::connecting_k(clusters) == m);
    CHECK(plexway::flann::connecting_k(clusters, m - 1) == std::nullopt);
  }
  CHECK(plexway::flann::connecting_k(Points{}) == 0u);
  CHECK(plexway::flann::connecting_k(Points(9, {1, 1, 1})) == 0u);
  CHECK(plexway::flann::connecting_k(Points{{0, 0, 0}, {1, 0, 0}}) == 1u);
}

TEST_CASE("neighbours on a surface reach the rows beside a row that is far from them") {
  using plexway::flann::surface_neighbours;
  samples::Uniform u(4);
  const double step = 0.01;
  for (const double apart : {8., 12., 25.}) {
    Points points;
    std::vector<int> row_of;
    for (int row = 0; row < 6; ++row)
      for (int i = 0; i < 120; ++i) {
        points.push_back({(i + u(-0.2, 0.2)) * step, (row * apart + u(-0.2, 0.2)) * step, 0});
        row_of.push_back(row);
      }
    const Neighbours near = surface_neighbours(points, {.symmetric = false});
    std::size_t left_out = 0;
    for (Index i = 0; i < points.size(); ++i) {
      bool below = row_of[i] == 0, above = row_of[i] == 5;
      for (const Index j : near.around(i)) {
        below |= row_of[j] == row_of[i] - 1;
        above |= row_of[j] == row_of[i] + 1;
      }
      left_out += !below || !above;
    }
    INFO(apart);
    CHECK(left_out <= 5);  // at the ends of rows
  }
}

TEST_CASE("where points lie by chance, neighbours on a surface are the k nearest but for a few") {
  using plexway::flann::surface_neighbours;
  for (const auto& cloud : {samples::plane_cloud(3000), samples::sphere_cloud(3000),
                            samples::swiss_cloud(3000), samples::wall_cloud(3000)}) {
    const Neighbours exact = plexway::flann::neighbours(cloud.points, {.symmetric = false});
    const Neighbours near = surface_neighbours(cloud.points, {.symmetric = false});
    std::size_t longer = 0;
    for (Index i = 0; i < cloud.points.size(); ++i) {
      const auto wanted = exact.around(i), found = near.around(i);
      REQUIRE(found.size() >= wanted.size());
      CHECK(std::equal(wanted.begin(), wanted.end(), found.begin()));
      longer += found.size() > wanted.size();
    }
    CHECK(longer <= 15);
  }
  // A curve has no rows beside it.
  Points line;
  for (int i = 0; i < 300; ++i) line.push_back({0.1 * i, 0, 0});
  CHECK(same(surface_neighbours(line), plexway::flann::neighbours(line)));
}

TEST_CASE("points nearly at one place do not hide the others from a search") {
  using plexway::flann::surface_neighbours;
  Points points = samples::plane_cloud(400).points;
  samples::Uniform u(8);
  for (Index i = 0; i < 400; ++i)
    for (int more = 0; more < 4; ++more)
      points.push_back({points[i][0] + u(-1e-9, 1e-9), points[i][1] + u(-1e-9, 1e-9), 0});
  const Neighbours near = surface_neighbours(points, {.symmetric = false});
  for (Index i = 0; i < 400; ++i) {
    std::size_t others = 0;
    for (const Index j : near.around(i)) others += samples::between(points[i], points[j]) > 1e-6;
    CHECK(others == 16);
  }
}

}  // namespace neighbours_test
