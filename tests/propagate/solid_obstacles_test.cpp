// Lines that are known to pass all obstacles of a solid are walked to their ends.

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <random>
#include <vector>

#include <plexway/solve.hpp>

#include "complex/test_solids.hpp"
#include "data/crack_plans.hpp"
#include "propagate/solid_closed_forms.hpp"
#include "propagate/solid_lines.hpp"
#include "propagate/solid_obstacles.hpp"
#include "propagate/solid_rule.hpp"
#include "propagate/solid_truth.hpp"

namespace plexway::solid_obstacles_test {

namespace {

using plexway::testing::NoFront;
using plexway::testing::point_in;
using plexway::testing::Solid;

// Of random lines, and of lines from reflex edges: how many are free, and known to be.
struct Shares {
  double lines, from_edges;
};
template <class Real>
Shares known_of_free(const Solid& solid, unsigned seed) {
  const auto mesh = solid.mesh<Real>();
  SolidObstacles<Real> obstacles;
  obstacles.measure(mesh);
  REQUIRE(!obstacles.empty());
  NoFront<Real> front;
  const SolidRule<Real, NoFront<Real>> rule(mesh, front);
  std::mt19937 random(seed);
  const auto tets = static_cast<Index>(mesh.tet_count());
  const auto edges = mesh.reflex_edges();
  std::size_t free[2] = {0, 0}, known[2] = {0, 0}, wrong = 0;
  for (int n = 0; n < 10000; ++n) {
    const Index home = plexway::testing::below(random, tets);
    const auto p = point_in(mesh, home, random);
    const Index there = plexway::testing::below(random, tets);
    const auto q = point_in(mesh, there, random);
    const Index number = plexway::testing::below(random, static_cast<Index>(edges.size()));
    const ReflexEdge<Real>& edge = edges[number];
    const Real share = static_cast<Real>(.05 + .9 * plexway::testing::uniform(random));
    const auto bend = edge.end[0] + share * edge.extent * edge.direction;
    const auto count = [&](int kind, bool clear, bool reaches) {
      free[kind] += reaches;
      known[kind] += clear;
      wrong += clear && !reaches;
    };
    Index t = home;
    count(0, obstacles.clear(none, edges.data(), p, q), rule.walk(t, p, q));
    t = home;
    count(1, obstacles.clear(number, edges.data(), bend, p),
          rule.walk(t, p, rule.beside(edge, bend)));
  }
  CAPTURE(known[0], free[0], known[1], free[1]);
  CHECK(wrong == 0);
  return {static_cast<double>(known[0]) / static_cast<double>(free[0]),
          static_cast<double>(known[1]) / static_cast<double>(free[1])};
}

// Blocks of cells taken out of a cube, which touch neither each other nor, all but one, the rim.
Solid blocks(Index n) {
  return plexway::testing::cubes(n, n, n, 1.0 / n, 0.2, [n](Index i, Index j, Index k) {
    const auto within = [n](Index x, double low, double high) {
      return x >= low * n && x < high * n;
    };
    return !(within(i, .2, .4) && within(j, .2, .5) && within(k, .3, .6)) &&
           !(within(i, .6, .8) && within(j, .6, .7) && within(k, .2, .8)) &&
           !(within(i, .6, .8) && within(j, .2, .4) && within(k, 0, .4));
  });
}

}  // namespace

TEMPLATE_TEST_CASE("lines that are known to be free are", "", float, double) {
  const Shares around_blocks = known_of_free<TestType>(blocks(20), 1);
  CHECK(around_blocks.lines > .8);
  CHECK(around_blocks.from_edges > .8);
  const Shares around_corner = known_of_free<TestType>(plexway::testing::l_shape(12), 2);
  CHECK(around_corner.lines > .8);
  CHECK(around_corner.from_edges > .99);
}

TEMPLATE_TEST_CASE("lines around a ball that are known to be free are", "", float, double) {
  const auto truth = plexway::testing::read_solid_truth("cavity_10k", 170).value();
  const Shares shares = known_of_free<TestType>(truth.solid, 3);
  CHECK(shares.lines > .8);
  CHECK(shares.from_edges > .9);
}

TEST_CASE("a solid without obstacles, or of lengths alone, has nothing that lines run into") {
  SolidObstacles<double> obstacles;
  obstacles.measure(blocks(10).mesh<double>());
  CHECK(!obstacles.empty());
  obstacles.measure(plexway::testing::solid_cube(8).mesh<double>());
  CHECK(obstacles.empty());
  const Solid s = blocks(10);
  obstacles.measure(TetMesh<double>(s.positions.size(), s.tets, s.lengths()));
  CHECK(obstacles.empty());
}

// Planes that a crack's faces lie in have its other side behind them as well.
TEST_CASE("no line is known to be free through cracks that fold, or from a block's side") {
  std::mt19937 random(7);
  const auto share = [&] { return plexway::testing::uniform(random); };
  using Cracks = std::vector<samples::CrackPlan::Crack>;
  const Cracks plans[] = {
      {{{2, 4}, {6, 4}}},                                      // a slit
      {{{2, 2}, {6, 2}}, {{6, 2}, {6, 6}}},                    // an L
      {{{2, 2}, {6, 2}}, {{4, 2}, {4, 6}}},                    // a T
      {{{2, 2}, {6, 2}}, {{2, 2}, {2, 5}}, {{6, 2}, {6, 5}}},  // a U
  };
  for (const Cracks& cracks : plans)
    for (int n = 0; n < 6; ++n) {
      const samples::CrackPlan plan(8, cracks, .08 * (n % 3), share);
      const auto solid = plan.solid(.1 + share() / 2);
      const TetMesh<double> mesh(solid.places, solid.tets);
      const auto floor = static_cast<Index>(plan.places().size());
      Index source = 0;
      do source = plexway::testing::below(random, floor);
      while (plan.on_crack(source));
      const auto truth = plan.distances(source);
      const auto found = solve(Serial{}, mesh, PointSource::at(source)).distance;
      double most_short = 0;
      for (Index v = 0; v < solid.places.size(); ++v) {
        const double exact = std::hypot(truth[v % floor], solid.places[v][2]);
        if (v != source) most_short = std::max(most_short, 1 - found[v] / exact);
      }
      CAPTURE(cracks.size(), n, source);
      CHECK(most_short < 1e-6);
    }
}

}  // namespace plexway::solid_obstacles_test
