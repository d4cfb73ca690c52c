#include <algorithm>
#include <array>
#include <catch2/catch.hpp>
#include <cmath>
#include <variant>
#include <vector>

#include <plexway/any_domain.hpp>

#include "complexes/test_solids.hpp"

namespace plexway::testing::walls_test {

namespace {

// Turned about a skew axis, scaled and moved: no face is parallel to an axis.
Position turned(const Position& p, double scale) {
  const double a = 0.7, b = 1.1;
  const Position q = {p[0] * std::cos(a) - p[1] * std::sin(a),
                      p[0] * std::sin(a) + p[1] * std::cos(a), p[2]};
  return {scale * (q[0] + 3), scale * (q[1] * std::cos(b) - q[2] * std::sin(b)),
          scale * (q[1] * std::sin(b) + q[2] * std::cos(b) - 1)};
}

// From the six walls of the unit cube.
double to_wall(const Position& p) {
  return std::min({p[0], p[1], p[2], 1 - p[0], 1 - p[1], 1 - p[2]});
}

}  // namespace

TEST_CASE("the boundary of a solid is its faces: exact in a turned cube of any unit") {
  for (const double scale : {1., 1e-150, 1e120}) {
    Solid solid = solid_cube(6);
    const std::vector<Position> places = solid.positions;
    for (Position& p : solid.positions) p = turned(p, scale);
    solid.positions.push_back({0, 0, 0});  // in no tetrahedron
    const AnyShape shape = AnyShape::solid(solid.positions, solid.tets);
    const AnyDomain domain(shape, {.precision = Precision::float64});
    const Source boundary = shape.boundary(0.25 * scale);
    const AnyField field = domain.solve(Serial{}, boundary);
    double worst = 0;
    for (std::size_t v = 0; v < places.size(); ++v)
      worst = std::max(worst, std::abs(field[v] / scale - 0.25 - to_wall(places[v])));
    INFO(scale);
    CHECK(worst < 1e-14);
    CHECK(std::isinf(field[places.size()]));
    // Beside another source the nearer counts.
    const Index middle =
        solid.nearest(turned({.5, .5, .5}, scale)[0], turned({.5, .5, .5}, scale)[1],
                      turned({.5, .5, .5}, scale)[2]);
    const std::vector<Source> both = {boundary, PointSource::at(middle)};
    const AnyField nearest = domain.solve(Serial{}, both);
    const double from_middle =
        std::hypot(places[0][0] - places[middle][0], places[0][1] - places[middle][1],
                   places[0][2] - places[middle][2]);
    CHECK(nearest[middle] == 0);
    CHECK(nearest.label()[middle] == 1);
    CHECK(nearest.label()[0] == 0);
    CHECK(nearest[0] / scale == Approx(std::min(0.25, from_middle)).epsilon(1e-12));
  }
}

TEST_CASE("the boundary of a solid by lengths alone is its vertices") {
  const Solid solid = solid_cube(3);
  const AnyShape shape = AnyShape::solid(solid.positions.size(), solid.tets, solid.lengths());
  const auto boundary = std::get<VertexSource>(shape.boundary());
  CHECK(boundary.offsets.empty());
  CHECK(boundary.vertices.size() < solid.positions.size());
}

}  // namespace plexway::testing::walls_test
