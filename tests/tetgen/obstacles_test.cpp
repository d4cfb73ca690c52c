#include <catch2/catch.hpp>
#include <cmath>
#include <random>

#include <plexway/solve.hpp>

#include "tetgen/solid_domains.hpp"

namespace obstacles_test {

// Distances around obstacles whose edges are not parallel, in a cube of tetrahedra, against ways
// around them by brute force.

namespace {

template <class Real>
void compare(const samples::Obstacles& obstacles, double tets, std::size_t sources) {
  const auto field = [](const auto& executor) {
    return [executor](const auto& mesh, const plexway::PointSource& source) {
      const auto found = plexway::solve(executor, mesh, source);
      return std::vector<double>(found.distance.begin(), found.distance.end());
    };
  };
  constexpr double rounding = std::is_same_v<Real, float> ? 2e-5 : 1e-6;
  for (const bench::ObstacleErrors& e : bench::obstacle_errors<Real>(
           obstacles, tets, 40, sources, field(plexway::Serial{}), field(plexway::OpenMP{2}))) {
    CAPTURE(obstacles.name, e.mean(), e.worst, e.in_sight, e.below);
    CHECK(e.mean() < 1e-4);
    CHECK(e.worst < 1e-2);
    CHECK(e.in_sight < rounding);
    CHECK(e.below > -rounding);  // every distance is the length of a path
  }
}

double between(std::mt19937& random, double low, double high) {
  return low + (high - low) * static_cast<double>(random()) / 4294967296.;
}

}  // namespace

TEST_CASE("around convex obstacles") {
  for (const samples::Obstacles& obstacles : samples::convex_obstacles())
    compare<double>(obstacles, 25e3, 3);
}

TEST_CASE("around convex obstacles in single precision") {
  for (const samples::Obstacles& obstacles : samples::convex_obstacles())
    compare<float>(obstacles, 8e3, 2);
}

TEST_CASE("around obstacles at random") {
  using samples::Point, samples::Polyhedron, samples::Turn;
  std::mt19937 random(7);
  const auto turn = [&] {
    return Turn(between(random, 0, 3), between(random, 0, 3), between(random, 0, 3));
  };
  for (int n = 0; n < 6; ++n) {
    const double far = between(random, -.1, .1);
    const Turn first = turn();
    samples::Obstacles obstacles{"at random " + std::to_string(n), {}};
    if (n % 3 == 0) {
      obstacles.blocks = {Polyhedron::block(
          {between(random, .03, .5), between(random, .2, .5), between(random, .2, .5)},
          {far, .1, 0}, first)};
    } else if (n % 3 == 1) {
      const auto size = [&] { return between(random, .3, .6); };
      obstacles.blocks = {Polyhedron::tetrahedron({{{size(), size(), size()},
                                                    {-size(), -size(), size()},
                                                    {-size(), size(), -size()},
                                                    {size(), -size(), -size()}}},
                                                  first)};
    } else {
      obstacles.blocks = {Polyhedron::block({.6, .12, .1}, {far, 0, .2}, first),
                          Polyhedron::block({.1, .6, .13}, {0, far, -.2}, first)};
    }
    compare<double>(obstacles, 25e3, 2);
  }
}

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

}  // namespace obstacles_test
