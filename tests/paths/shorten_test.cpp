#include <plexway/error.hpp>
#include <plexway/paths/shorten.hpp>

#include <array>
#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>
#include <vector>

namespace plexway::testing::shorten_test {

namespace {

constexpr Index sides = 12, rings = 8;
constexpr double height = 2;

// A tube of flat sides, which unrolls into the plane.
struct Tube {
  std::vector<std::array<double, 3>> positions;
  std::vector<std::array<Index, 3>> faces;

  Tube() {
    for (Index k = 0; k <= rings; ++k)
      for (Index i = 0; i < sides; ++i) {
        const double angle = 2 * std::numbers::pi * i / sides;
        positions.push_back({std::cos(angle), std::sin(angle), height * k / rings});
      }
    for (Index k = 0; k < rings; ++k)
      for (Index i = 0; i < sides; ++i) {
        const Index a = k * sides + i, b = k * sides + (i + 1) % sides;
        faces.push_back({a, b, a + sides});
        faces.push_back({b, b + sides, a + sides});
      }
  }
};
const double around = 2 * sides * std::sin(std::numbers::pi / sides);

// `turns` times around along edges, then straight up.
std::vector<PathPoint> staircase(int turns) {
  std::vector<PathPoint> path;
  for (int t = 0; t < turns; ++t)
    for (Index i = 0; i < sides; ++i) path.push_back({2 * i, {1, 0, 0, 0}});
  for (Index k = 0; k < rings; ++k) path.push_back({2 * k * sides, {1, 0, 0, 0}});
  path.push_back({2 * (rings - 1) * sides, {0, 0, 1, 0}});
  return path;
}

}  // namespace

TEMPLATE_TEST_CASE("a path that is pulled tight keeps its turns", "", float, double) {
  const Tube tube;
  const TriangleMesh<TestType> mesh(tube.positions, tube.faces);
  for (const int turns : {0, 1, 2, 5}) {
    const Path path = shortened(mesh, staircase(turns), tube.positions);
    CHECK(path.length == Approx(std::hypot(turns * around, height)).epsilon(1e-12));
    CHECK(path.positions.front() == tube.positions[0]);
    CHECK(path.positions.back() == tube.positions[rings * sides]);
    // And once more it is what it was.
    CHECK(shortened(mesh, path.points, tube.positions).length == Approx(path.length));
  }
  const Path unplaced = shortened(mesh, staircase(1));
  CHECK(unplaced.length == Approx(std::hypot(around, height)).epsilon(1e-6));
  CHECK(unplaced.positions.empty());
}

TEST_CASE("what is no path is not pulled") {
  const Tube tube;
  const TriangleMesh<double> mesh(tube.positions, tube.faces);
  CHECK_THROWS_AS(shortened(mesh, std::vector<PathPoint>{}), UsageError);
  const std::vector<PathPoint> outside = {{7777, {1, 0, 0, 0}}};
  CHECK_THROWS_AS(shortened(mesh, outside), UsageError);
  const std::vector<PathPoint> apart = {{0, {1, 0, 0, 0}}, {100, {1, 0, 0, 0}}};
  CHECK_THROWS_WITH(shortened(mesh, apart), "points 0 and 1 of the path are in no common triangle");
  const std::vector<PathPoint> still = {{0, {.5, .5, 0, 0}}};
  CHECK(shortened(mesh, still, tube.positions).length == 0);
}

}  // namespace plexway::testing::shorten_test
