#include <catch2/catch.hpp>

#include <thread>
#include <type_traits>

#include <plexway/error.hpp>
#include <plexway/solve.hpp>

#include "complexes/test_wires.hpp"
#include "executors/parity.hpp"
#include "executors/piece_testing.hpp"
#include "executors/team_cases.hpp"
#include "labels/simplex_testing.hpp"
#include "labels/solid_solving.hpp"
#include "labels/solving.hpp"
#include "with_accuracy.hpp"

namespace plexway::testing::openmp_test {

namespace {

// The same bits whatever the number of threads, the chunk, and what the workspace did before.
template <class Domain>
void check_same_bits(const Domain& domain, const PropagateOptions& options, unsigned seed) {
  WorkspaceOf<Serial, Domain> workspace;
  DistanceField<RealOf<Domain>> first, field;
  for (const std::size_t count : {1u, 6u}) {
    const auto sources = random_sources(domain, count, seed);
    solve(team(1), domain, sources, options, workspace, first);
    for (const OpenMP& executor : {team(2), team(8), OpenMP{2, 1, 64}, OpenMP{3, 1000, 64}}) {
      solve(executor, domain, sources, options, workspace, field);
      CHECK(same_bits(first, field));
    }
    solve(Serial{}, domain, sources, options, workspace, field);
    solve(team(2), domain, sources, options, workspace, field);
    CHECK(same_bits(first, field));
  }
}

}  // namespace

TEMPLATE_TEST_CASE("any number of threads gives the same bits on surfaces", "[threads]", float,
                   double) {
  unsigned seed = 0;
  for (const Surface& s : surfaces())
    for (const Visibility visibility : visibilities)
      for (const Schedule schedule : {Schedule::dual_queue, Schedule::fifo}) {
        if (schedule == Schedule::fifo && visibility != Visibility::saddles) continue;
        PropagateOptions options = by_labels();
        options.visibility = visibility;
        options.schedule = schedule;
        INFO("surface " << seed << " " << name(options));
        check_same_bits(s.mesh<TestType>(), options, ++seed);
      }
}

TEMPLATE_TEST_CASE("any number of threads gives the same bits in solids", "[threads]", float,
                   double) {
  unsigned seed = 0;
  for (const Solid& s :
       {solid_cube(5), l_shape(4), walled(6), edge_touch(3), vertex_touch(3), walled(4, 0)})
    for (const Visibility visibility : solid_visibilities) {
      PropagateOptions options = by_labels();
      options.visibility = visibility;
      INFO("solid " << seed << " " << name(options));
      check_same_bits(s.mesh<TestType>(), options, ++seed);
    }
}

TEMPLATE_TEST_CASE("any number of threads gives the same bits elsewhere", "[threads]", float,
                   double) {
  for (unsigned seed = 1; seed <= 4; ++seed)
    check_same_bits(random_wires(seed, 500, 1200, 0.7 * seed).wireframe<TestType>(), by_labels(),
                    seed);
  check_same_bits(cube_grid<2>(12).template complex<TestType>(), by_labels(), 2);
  check_same_bits(cube_grid<3>(5, 3).template complex<TestType>(), by_labels(), 3);
  check_same_bits(cube_grid<4>(3).template complex<TestType>(), by_labels(), 4);
}

TEST_CASE("200 solves on eight threads are one", "[threads]") {
  const auto mesh = sphere(4).mesh<float>();
  const auto sources = random_sources(mesh, 5, 1);
  Workspace<float> workspace;
  DistanceField<float> first, field;
  solve(team(8), mesh, sources, by_labels(), workspace, first);
  std::size_t others = 0;
  for (int i = 0; i < 200; ++i) {
    solve(team(8), mesh, sources, by_labels(), workspace, field);
    others += !same_bits(first, field);
  }
  CHECK(others == 0);
}

TEST_CASE("queues grow when every vertex is a source", "[threads]") {
  for (const int threads : {1, 8}) check_every_vertex_a_source(team(threads));
}

TEST_CASE("a team keeps radius, offsets and sources inside triangles", "[threads]") {
  check_radius_and_offsets(team(4));
}

TEST_CASE("a team stops where it is told", "[threads]") {
  const auto mesh = grid(60, 60).mesh<float>();
  PropagateOptions options = by_labels();
  const auto whole = solve(team(4), mesh, PointSource::at(0), options);
  CHECK(whole.complete);
  for (const std::size_t most : {0u, 1u, 100u, 3000u}) {
    options.max_expansions = most;
    const auto field = solve(team(4), mesh, PointSource::at(0), options);
    CHECK(!field.complete);
    CHECK(field.statistics.expansions == most);
    CHECK(field.distance[0] == 0);
    bool no_less = true;
    for (std::size_t v = 0; v < field.distance.size(); ++v)
      no_less = no_less && field.distance[v] >= whole.distance[v] * (1 - 1e-5f);
    CHECK(no_less);
  }
  options.max_expansions = whole.statistics.expansions;
  CHECK(same_bits(whole, solve(team(4), mesh, PointSource::at(0), options)));
}

TEST_CASE("a team reports to the calling thread and can be cancelled", "[threads]") {
  check_reports(team(4), by_labels());
}

TEST_CASE("so it is while vertices of a flat domain tell each other", "[threads]") {
  const HoledCube<3> cube(24);  // vertices for several threads
  const auto domain = cube.complex<double>();
  const PointSource source = PointSource::at(0);
  const auto caller = std::this_thread::get_id();
  bool by_caller = true;
  PauseWatch watch;
  PropagateOptions options;
  options.progress = [&](const Progress& p) {
    by_caller = by_caller && std::this_thread::get_id() == caller;
    return watch(p);
  };
  const auto whole = solve(team(4), domain, source, options);
  CHECK(by_caller);
  const int calls = watch.calls;
  CHECK(calls > 0);
  for (const int cancelled_at : {1, (calls + 1) / 2}) {
    watch = {};
    watch.cancelled_at = cancelled_at;
    CHECK_THROWS_AS(solve(team(4), domain, source, options), Cancelled);
    CHECK(watch.calls == cancelled_at);
  }
  struct Own {};
  watch = {};
  options.progress = [&](const Progress& p) -> bool {
    watch(p);
    if (watch.calls > 0) throw Own{};
    return true;
  };
  CHECK_THROWS_AS(solve(team(4), domain, source, options), Own);
  options.progress = nullptr;
  CHECK(same_bits(whole, solve(team(4), domain, source, options)));
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
  refused({.chunk = 0}, mesh);
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
