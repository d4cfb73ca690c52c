#include <catch2/catch.hpp>

#include <cmath>

#include "data/tuning_shapes.hpp"
#include "labels/solving.hpp"

namespace plexway::testing::tube_test {

// A spring of five turns about the z axis: its tube of radius 0.12 winds about a circle of radius
// 1, 260 rings of 8 vertices. No point of it is nearer to the axis than `inside`, so a path that
// turns by an angle and climbs by a height is no shorter than on a cylinder of that radius.
TEMPLATE_TEST_CASE("no distance along a tube that winds is shorter than its inside", "", float,
                   double) {
  const samples::Shape spring = samples::tuning::spring();
  const TriangleMesh<TestType> mesh(spring.points, spring.faces);
  const double turn = 10 * samples::pi / 260, inside = 0.88 * std::cos(turn);
  const auto angle = [&](Index v) {  // about the axis, turns counted
    const double ring = turn * (v / 8);
    const samples::Point& p = spring.points[v];
    return ring + std::remainder(std::atan2(p[1], p[0]) - ring, 2 * samples::pi);
  };
  for (const Index source : {Index{0}, Index{1044}, Index{2070}}) {
    const std::vector<double> distance = solve(mesh, PointSource::at(source));
    double worst = 0;
    for (Index v = 0; v < distance.size(); ++v) {
      const double least = std::hypot(inside * (angle(v) - angle(source)),
                                      spring.points[v][2] - spring.points[source][2]);
      worst = std::min(worst, distance[v] - least * 0.99);
      REQUIRE(std::isfinite(distance[v]));
    }
    INFO("from " << source);
    CHECK(worst >= -0.02);
  }
}

}  // namespace plexway::testing::tube_test
