#include <plexway/cloud/neighbours.hpp>

#include <catch2/catch.hpp>
#include <set>

#include <plexway/common/distinct_points.hpp>
#include <plexway/error.hpp>

#include "complexes/test_clouds.hpp"

namespace neighbours_test {

using plexway::Index;
using plexway::Neighbours;

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

}  // namespace neighbours_test
