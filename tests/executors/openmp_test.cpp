#include <catch2/catch.hpp>

#include <type_traits>

#include <plexway/error.hpp>
#include <plexway/solve.hpp>

#include "complexes/test_wires.hpp"
#include "executors/parity.hpp"
#include "executors/piece_testing.hpp"
#include "labels/simplex_testing.hpp"
#include "labels/solid_solving.hpp"
#include "labels/solving.hpp"
#include "with_accuracy.hpp"

namespace plexway::testing::openmp_test {

namespace {

// The same bits whatever the number of threads, and what the workspace did before.
template <class Domain>
void check_same_bits(const Domain& domain, const PropagateOptions& options, unsigned seed) {
  WorkspaceOf<Serial, Domain> workspace;
  DistanceField<RealOf<Domain>> first, field;
  for (const std::size_t count : {1u, 6u}) {
    const auto sources = random_sources(domain, count, seed);
    solve(team(1), domain, sources, options, workspace, first);
    for (const OpenMP& executor : {team(2), team(3), team(8)}) {
      solve(executor, domain, sources, options, workspace, field);
      CHECK(same_bits(first, field));
    }
    solve(Serial{}, domain, sources, options, workspace, field);
    solve(team(2), domain, sources, options, workspace, field);
    CHECK(same_bits(first, field));
  }
}

}  // namespace

TEMPLATE_TEST_CASE("any number of threads gives the same bits elsewhere", "[threads]", float,
                   double) {
  for (unsigned seed = 1; seed <= 4; ++seed)
    check_same_bits(random_wires(seed, 500, 1200, 0.7 * seed).wireframe<TestType>(), by_labels(),
                    seed);
  check_same_bits(cube_grid<2>(12).template complex<TestType>(), by_labels(), 2);
  check_same_bits(cube_grid<3>(5, 3).template complex<TestType>(), by_labels(), 3);
  check_same_bits(cube_grid<4>(3).template complex<TestType>(), by_labels(), 4);
}

TEST_CASE("a team refuses what needs order, and settings that make no sense", "[threads]") {
  const auto mesh = grid(3, 3).mesh<float>();
  PropagateOptions options = by_labels();
  options.schedule = Schedule::priority;
  const auto refused = [&](const OpenMP& executor, const auto& domain,
                           const PropagateOptions& with = by_labels()) {
    CHECK_THROWS_AS(solve(executor, domain, PointSource::at(0), with), UsageError);
  };
  refused({}, mesh, options);
  refused({}, solid_cube(1).mesh<float>(), options);
  refused({}, random_wires(1, 10, 20).wireframe<float>(), options);
  refused({}, cube_grid<2>(2).complex<float>(), options);
  refused({.threads = -1}, mesh);
  refused({.threads = 1 << 20}, mesh);
  refused({.threads = -1}, mesh, {});
  options = by_labels();
  options.visibility = Visibility::tuned;
  refused({}, solid_cube(1).mesh<float>(), options);
  CHECK_THROWS_AS(solve(OpenMP{}, mesh, PointSource::at(99)), UsageError);
  CHECK_THROWS_AS(solve(OpenMP{}, mesh, std::span<const PointSource>{}), UsageError);
}

TEMPLATE_TEST_CASE("by default a team gives the bits of one thread", "[threads]", float, double) {
  unsigned seed = 0;
  for (const Surface& s :
       {sphere(4), moebius(60, 8), bow_tie(10), soup(60, 120, 1), sheets(3, 8)}) {
    const auto mesh = s.mesh<TestType>();
    for (const std::size_t count : {1u, 5u}) {
      const auto sources = random_sources(mesh, count, ++seed);
      const auto alone = solve(Serial{}, mesh, sources);
      CHECK(alone.accuracy == Accuracy::accurate());
      const auto several = solve(OpenMP{2}, mesh, sources);
      CHECK(same_bits(alone, several));
      CHECK(alone.error == several.error);
      const auto rows = solve_each(team(2), mesh, std::span<const PointSource>(sources));
      const auto first = solve(Serial{}, mesh, sources[0]);
      CHECK(std::equal(rows.row(0).begin(), rows.row(0).end(), first.distance.begin()));
    }
  }
}

TEST_CASE("nearest first is a schedule", "[threads]") {
  CHECK(NearestFirst{}.schedule == Schedule::priority);
}

}  // namespace plexway::testing::openmp_test
