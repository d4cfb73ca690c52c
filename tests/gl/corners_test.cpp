// Flat domains with corners on a GL device: no light leaks behind them, as with one thread
// (tests/labels/corners_test.cpp). The exact distances are those of a visibility graph.

#include <catch2/catch.hpp>

#include <plexway/executors/gl.hpp>

#include "data/corner_domains.hpp"
#include "gl/device.hpp"
#include "labels/solving.hpp"

namespace plexway::testing::corners_test {

TEST_CASE("a device knows of corners as one thread does", "[gl]") {
  if (!device()) return;
  for (const samples::CornerDomain& domain : samples::corner_domains())
    for (const Index n : {50u, 100u}) {
      const samples::Shape grid = domain.grid(n);
      const TriangleMesh<float> mesh(grid.points, grid.faces);
      const auto field = solve(GL{}, mesh, PointSource::at(0));
      const Errors errors = compare(field.distance, domain.distances(grid.points));
      CAPTURE(domain.name, n, errors.mean, errors.max, errors.below);
      CHECK(errors.fits);
      CHECK(errors.mean <= 2e-6);
      CHECK(errors.max <= 1e-3);
      CHECK(errors.below >= -1e-4);
    }
}

}  // namespace plexway::testing::corners_test
