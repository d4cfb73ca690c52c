#include <catch2/catch.hpp>
#include <cmath>

#include <plexway/solve.hpp>

#include "tetgen/solid_domains.hpp"

namespace convergence_test {

namespace {

double mean_error(const bench::SolidDomain& domain) {
  const plexway::TetMesh<double> mesh(domain.positions, domain.tets);
  const auto field =
      plexway::solve(plexway::Serial{}, mesh, plexway::PointSource::at(domain.truth.source));
  bench::Errors errors;
  errors.add(domain.truth, field.distance);
  REQUIRE(errors.summary()->wrong == 0);
  return errors.summary()->mean;
}

}  // namespace

TEST_CASE("exact distances around a prism are those around a round pipe in the limit") {
  // In the plane: along two tangents and the arc between.
  const std::vector<samples::Point> points = {{.9, .1, .7}, {.3, .8, .2},   {0, .5, 0},
                                              {.5, 0, 1},   {-.4, -.7, .5}, {-.9, 0, .4}};
  const samples::Point source = {-.8, .1, .2};
  for (const samples::Index sides : {100u, 400u}) {
    const auto found = samples::PipePrism{sides}.distances(points, source);
    for (std::size_t i = 0; i < points.size(); ++i) {
      const samples::Point& p = points[i];
      const double r = std::hypot(source[0], source[1]), q = std::hypot(p[0], p[1]);
      const double turn = std::abs(
          std::atan2(source[0] * p[1] - source[1] * p[0], source[0] * p[0] + source[1] * p[1]));
      const double arc = turn - std::acos(.5 / r) - std::acos(std::min(1., .5 / q));
      const double flat =
          arc > 0 ? std::sqrt(r * r - .25) + std::sqrt(std::max(0., q * q - .25)) + arc / 2
                  : std::hypot(p[0] - source[0], p[1] - source[1]);
      CAPTURE(sides, i);
      CHECK(found[i] == Approx(std::hypot(flat, p[2] - source[2])).epsilon(15. / sides / sides));
    }
  }
}

TEST_CASE("around a pipe errors stay far below those of its facets") {
  // 54 sides would be 6e-4 off the round pipe; a rule that forgets one edge in 50, 1e-4.
  CHECK(mean_error(bench::pipe_domain(10e3)) < 1e-9);
  CHECK(mean_error(bench::pipe_domain(40e3)) < 1e-6);
}

TEST_CASE("around a ball errors fall with the size of tetrahedra") {
  const double coarse = mean_error(bench::cavity_domain(10e3));
  const double fine = mean_error(bench::cavity_domain(40e3));
  CAPTURE(coarse, fine);
  CHECK(coarse < 4e-4);
  CHECK(fine < coarse / 2.5);
}

}  // namespace convergence_test
