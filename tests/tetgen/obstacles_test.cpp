#include <catch2/catch.hpp>
#include <random>

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

}  // namespace obstacles_test
