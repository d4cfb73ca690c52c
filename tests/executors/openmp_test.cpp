#include <atomic>
#include <catch2/catch.hpp>
#include <chrono>
#include <cstddef>
#include <cstring>
#include <thread>

#include <plexway/error.hpp>
#include <plexway/solve.hpp>

#include "complexes/test_wires.hpp"
#include "executors/parity.hpp"
#include "executors/piece_testing.hpp"
#include "executors/threads/team.hpp"
#include "labels/simplex_testing.hpp"
#include "labels/solid_solving.hpp"
#include "labels/solving.hpp"
#include "with_accuracy.hpp"

namespace plexway::testing::openmp_test {
using namespace detail;

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

TEST_CASE("the same bits whoever works, and though that changes in between", "[threads]") {
  std::atomic<bool> done{false};
  std::thread other([&] {
    for (unsigned i = 0; !done; ++i) {
      Crowding::report(i % 3 == 0 ? 0.5 : 2, 1);
      std::this_thread::sleep_for(std::chrono::microseconds(50 * (i % 7)));
    }
  });
  const Surface s = sphere(5);
  const auto mesh = s.mesh<float>();
  Workspace<float> workspace;
  DistanceField<float> first, field;
  for (const Accuracy accuracy : {Accuracy::fast(), Accuracy::accurate()}) {
    PropagateOptions options;
    options.accuracy = accuracy;
    for (const Index source : {Index{3}, Index{500}}) {
      solve(pieces(1, 100), mesh, PointSource::at(source), options, workspace, first);
      for (int k = 0; k < 20; ++k) {
        solve(pieces(1 + k % 3, 100), mesh, PointSource::at(source), options, workspace, field);
        CHECK(same_bits(first, field));
      }
    }
  }
  done = true;
  other.join();
  Crowding::report(2, 1);
}

namespace {

// Row k is what `solve` finds from source k, by one thread or by several.
template <class Domain>
void check_rows(const Domain& domain, std::size_t count) {
  using Real = RealOf<Domain>;
  const auto sources = random_sources(domain, count, 11);
  const auto alone = solve_each(Serial{}, domain, std::span<const PointSource>(sources));
  const auto shared =
      solve_each(OpenMP{.threads = 3}, domain, std::span<const PointSource>(sources));
  REQUIRE(alone.rows() == count);
  REQUIRE(alone.columns() == domain.vertex_count());
  REQUIRE(alone.values().size() == shared.values().size());
  CHECK(std::memcmp(alone.values().data(), shared.values().data(), alone.values().size_bytes()) ==
        0);
  CHECK(alone.complete);
  CHECK(shared.complete);
  for (std::size_t k = 0; k < count; ++k) {
    const DistanceField<Real> one = solve(Serial{}, domain, sources[k]);
    CHECK(std::equal(one.distance.begin(), one.distance.end(), shared.row(k).begin()));
    CHECK(shared.row(k).data() == shared.values().data() + k * shared.columns());
  }
}

}  // namespace

TEMPLATE_TEST_CASE("fields has a row for each source, on every domain", "[threads]", float,
                   double) {
  check_rows(sphere(3).mesh<TestType>(), 9);
  check_rows(soup(60, 120, 1).mesh<TestType>(), 4);
  check_rows(walled(4).mesh<TestType>(), 5);
  check_rows(random_wires(2, 300, 700).wireframe<TestType>(), 7);
  check_rows(cube_grid<3>(3).template complex<TestType>(), 4);
  MixedComplex<TestType> mixed;
  const auto a = mixed.add(grid(6, 6).mesh<TestType>());
  const auto b = mixed.add(grid(4, 4).mesh<TestType>());
  const std::array<Index, 2> pairs[] = {{6, 0}, {13, 5}, {20, 10}};
  mixed.weld(a, b, std::span<const std::array<Index, 2>>(pairs));
  check_rows(mixed, 4);
}

TEST_CASE("field is the distance from the nearest source, fields those from each", "[threads]") {
  // By labels both are exact on a flat grid and in a wireframe, so the least over the rows is the
  // field.
  const auto compare_with_least = [](const auto& domain, double tolerance) {
    const auto sources = random_sources(domain, 6, 5);
    const std::span<const PointSource> all(sources);
    const auto rows = solve_each(OpenMP{.threads = 2}, domain, all, by_labels());
    for (const auto& nearest :
         {solve(Serial{}, domain, all, by_labels()), solve(team(2), domain, all, by_labels()),
          solve(team(8), domain, all, by_labels())}) {
      double worst = 0;
      bool labels = true;
      for (std::size_t v = 0; v < nearest.distance.size(); ++v) {
        double least = std::numeric_limits<double>::infinity();
        for (std::size_t k = 0; k < rows.rows(); ++k)
          least = std::min(least, static_cast<double>(rows.row(k)[v]));
        if (std::isinf(least)) {
          labels = labels && std::isinf(nearest.distance[v]) && nearest.label[v] == none;
          continue;
        }
        worst = std::max(worst, std::abs(nearest.distance[v] - least));
        // The label names a source that is as near: labels differ at ties only.
        labels = labels && rows.row(nearest.label[v])[v] - least <= tolerance;
      }
      CHECK(worst <= tolerance);
      CHECK(labels);
    }
  };
  compare_with_least(grid(30, 30).mesh<double>(), 1e-12);
  compare_with_least(random_wires(7, 800, 2000).wireframe<double>(), 0);
}

TEST_CASE("fields takes every option that Serial takes", "[threads]") {
  const auto mesh = grid(20, 20).mesh<float>();
  const auto sources = random_sources(mesh, 5, 1);
  const std::span<const PointSource> all(sources);
  PropagateOptions options;
  options.schedule = Schedule::priority;
  options.radius = 0.4;
  const auto rows = solve_each(OpenMP{.threads = 2}, mesh, all, options);
  const auto one = solve(Serial{}, mesh, sources[4], options);
  CHECK(std::equal(one.distance.begin(), one.distance.end(), rows.row(4).begin()));
  options.max_expansions = 10;
  CHECK(!solve_each(OpenMP{.threads = 2}, mesh, all, options).complete);
  CHECK(!solve_each(Serial{}, mesh, all, options).complete);
  CHECK(solve_each(OpenMP{}, mesh, std::span<const PointSource>{}).rows() == 0);
}

TEST_CASE("fields passes exceptions on", "[threads]") {
  const auto mesh = grid(200, 200).mesh<float>();
  auto sources = random_sources(mesh, 8, 1);
  PropagateOptions options;
  options.progress = [](const Progress&) { return false; };
  CHECK_THROWS_AS(
      solve_each(OpenMP{.threads = 1}, mesh, std::span<const PointSource>(sources), options),
      Cancelled);
  sources[5] = PointSource::at(1u << 30);
  CHECK_THROWS_AS(solve_each(OpenMP{.threads = 4}, mesh, std::span<const PointSource>(sources)),
                  UsageError);
  CHECK_THROWS_AS(solve_each(Serial{}, mesh, std::span<const PointSource>(sources)), UsageError);
}

}  // namespace plexway::testing::openmp_test
