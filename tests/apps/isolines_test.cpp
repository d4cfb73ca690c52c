#include <catch2/catch.hpp>
#include <cmath>
#include <limits>
#include <numbers>

#include <plexway/apps/isolines.hpp>
#include <plexway/error.hpp>

#include "complex/test_meshes.hpp"

using namespace plexway;
using namespace plexway::testing;

TEST_CASE("isolines of a height are level and as long as they should be") {
  const Surface s = sphere(4);
  std::vector<double> height;
  for (const Position& p : s.positions) height.push_back(p[2]);
  const double values[] = {-0.5, 0.25, 7};
  const auto lines = isolines(s.positions, s.faces, height, values);
  REQUIRE(lines.size() == 2);  // no value is reached at 7
  for (std::size_t n = 0; n < 2; ++n) {
    const Path& line = lines[n];
    CHECK(line.source == n);
    CHECK(line.positions.front() == line.positions.back());  // closed
    for (const Position& p : line.positions) CHECK(p[2] == Approx(values[n]).margin(1e-9));
    const double radius = std::sqrt(1 - values[n] * values[n]);
    CHECK(line.length == Approx(2 * std::numbers::pi * radius).epsilon(1e-2));
    // Each piece lies in the simplex of its first point.
    for (std::size_t i = 0; i + 1 < line.points.size(); ++i) {
      const PathPoint& at = line.points[i];
      for (std::size_t k = 0; k < 3; ++k) {
        double x = 0;
        for (std::size_t c = 0; c < 3; ++c)
          x += at.barycentric[c] * s.positions[s.faces[at.simplex][c]][k];
        CHECK(x == Approx(line.positions[i][k]).margin(1e-12));
      }
    }
  }
}

TEST_CASE("isolines end at the boundary and at what is not reached") {
  const Surface s = grid(10, 10);
  std::vector<double> x;
  for (const Position& p : s.positions) x.push_back(p[0]);
  const double value[] = {0.5};  // through vertices
  auto lines = isolines(s.positions, s.faces, x, value);
  REQUIRE(lines.size() == 1);
  CHECK(lines[0].length == Approx(1));
  x[s.nearest(0.5, 0.5)] = std::numeric_limits<double>::infinity();
  lines = isolines(s.positions, s.faces, x, value);
  CHECK(lines.size() == 2);
  CHECK_THROWS_AS(isolines(s.positions, s.faces, std::vector<double>(3), value), UsageError);
  const double no[] = {std::nan("")};
  CHECK_THROWS_AS(isolines(s.positions, s.faces, x, no), UsageError);
}
