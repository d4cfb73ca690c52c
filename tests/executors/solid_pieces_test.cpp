#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <random>

#include <plexway/error.hpp>
#include <plexway/solve.hpp>

#include "complexes/test_solids.hpp"
#include "executors/parity.hpp"
#include "executors/piece_testing.hpp"
#include "labels/solid_solving.hpp"
#include "with_accuracy.hpp"

namespace plexway::testing::solid_pieces_test {

// Solids by pieces (OpenMP::piece).

namespace {

struct Named {
  const char* name;
  Solid solid;
};
std::vector<Named> solids() {
  return {{"cube", solid_cube(5)},
          {"L", l_shape(6)},
          {"wall", walled(8, 0.25)},
          {"pipe", pipe(12, 3, 4)},
          {"edge", edge_touch(6)},
          {"vertex", vertex_touch(4)},
          {"far", moved(l_shape(4), 1e3, {5e3, 0, 1e3})}};
}

}  // namespace

TEMPLATE_TEST_CASE("pieces: solids have the same bits with any number of threads", "[threads]",
                   float, double) {
  unsigned seed = 0;
  for (const Named& named : solids()) {
    const char* const name = named.name;
    const auto mesh = named.solid.mesh<TestType>();
    Workspace<TestType> workspace;
    DistanceField<TestType> first, field;
    for (const Visibility visibility : solid_visibilities)
      for (const std::size_t count : {1u, 4u}) {
        PropagateOptions options = by_labels();
        options.visibility = visibility;
        const auto sources = random_sources(mesh, count, ++seed);
        solve(pieces(1, 60), mesh, sources, options, workspace, first);
        for (const int threads : {2, 3, 8}) {
          solve(pieces(threads, 60), mesh, sources, options, workspace, field);
          INFO(name << ", seed " << seed << ", threads " << threads);
          CHECK(same_bits(first, field));
        }
        // Whatever was solved before.
        solve(pieces(2, 100), mesh, sources, options, workspace, field);
        solve(Serial{}, mesh, sources, options, workspace, field);
        solve(pieces(2, 60), mesh, sources, options, workspace, field);
        CHECK(same_bits(first, field));
        // A single piece is the serial loop.
        CHECK(same_bits(solve(Serial{}, mesh, sources, options),
                        solve(pieces(2, mesh.tet_count()), mesh, sources, options)));
      }
  }
}

TEST_CASE("pieces: 200 solves of a solid on eight threads are one", "[threads]") {
  const auto mesh = walled(8, 0.25).mesh<float>();
  const auto sources = random_sources(mesh, 3, 1);
  Workspace<float> workspace;
  DistanceField<float> first, field;
  solve(pieces(8, 300), mesh, sources, by_labels(), workspace, first);
  std::size_t others = 0;
  for (int i = 0; i < 200; ++i) {
    solve(pieces(8, 300), mesh, sources, by_labels(), workspace, field);
    others += !same_bits(first, field);
  }
  CHECK(others == 0);
}

TEST_CASE("pieces: labels of solids are as accurate as Serial's") {
  double serial = 0, by_pieces = 0;
  for (const auto& [name, s] : solids()) {
    const auto mesh = s.mesh<double>();
    for (unsigned seed = 1; seed <= 2; ++seed) {
      const auto sources = random_sources(mesh, 1, seed);
      const auto exact = solve(Serial{}, mesh, sources);  // strings
      const Parity one = parity(exact, solve(Serial{}, mesh, sources, by_labels()));
      const Parity several = parity(exact, solve(pieces(2, 60), mesh, sources, by_labels()));
      INFO(name << ", seed " << seed << ": " << several.mean << ", worst " << several.worst);
      CHECK(several.reached_by_one == 0);
      serial += one.mean;
      by_pieces += several.mean;
    }
  }
  REQUIRE(serial > 0);
  INFO("Serial " << serial << ", pieces " << by_pieces);
  CHECK(by_pieces < 1.05 * serial);
}

TEST_CASE("pieces: radius, offsets and budgets in solids", "[threads]") {
  const Solid s = l_shape(8);
  const auto mesh = s.mesh<double>();
  const auto whole = solve(pieces(4, 100), mesh, PointSource::at(0), by_labels());
  PropagateOptions options = by_labels();
  options.radius = 0.5;
  PointSource from = PointSource::at(0);
  from.offset = 0.1;
  const auto near = solve(pieces(4, 100), mesh, from, options);
  CHECK(near.distance[0] == 0.1);
  std::size_t wrong = 0, beyond = 0;
  for (std::size_t v = 0; v < near.distance.size(); ++v) {
    beyond += std::isinf(near.distance[v]);
    const double exact = whole.distance[v] + 0.1;
    if (std::isinf(near.distance[v]))
      wrong += exact < 0.5 - 1e-9;
    else
      wrong += std::abs(near.distance[v] - exact) > 1e-9;
  }
  CHECK(wrong == 0);
  CHECK(beyond > 10);
  for (const std::size_t most : {0u, 1u, 300u}) {
    options = by_labels();
    options.max_expansions = most;
    const auto field = solve(pieces(4, 100), mesh, PointSource::at(0), options);
    CHECK(!field.complete);
    CHECK(field.statistics.expansions == most);
    CHECK(same_bits(field, solve(pieces(1, 100), mesh, PointSource::at(0), options)));
  }
  options = by_labels();
  options.progress = [](const Progress&) { return false; };
  Workspace<double> workspace;
  DistanceField<double> field;
  const PointSource source[] = {PointSource::at(0)};
  const auto large = solid_cube(24).mesh<double>();
  CHECK_THROWS_AS(solve(pieces(4, 2000), large, source, options, workspace, field), Cancelled);
  solve(pieces(4, 100), mesh, source, by_labels(), workspace, field);
  CHECK(same_bits(field, whole));
}

}  // namespace plexway::testing::solid_pieces_test
