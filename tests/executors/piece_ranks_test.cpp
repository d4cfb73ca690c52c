#include <catch2/catch.hpp>

#include <atomic>
#include <cstddef>
#include <string>
#include <utility>
#include <vector>

#include <plexway/error.hpp>
#include <plexway/solve.hpp>

#include "complexes/jittered.hpp"
#include "complexes/test_solids.hpp"
#include "complexes/test_wires.hpp"
#include "executors/parity.hpp"
#include "executors/piece_testing.hpp"
#include "executors/thread_ranks.hpp"
#include "labels/solving.hpp"
#include "with_accuracy.hpp"

namespace plexway::testing::piece_ranks_test {

// Pieces shared by several processes (OpenMP::ranks), which are threads here. By MPI: tests/mpi.

namespace {

/// Ranks and the threads of each.
using Schedulers = std::vector<std::pair<std::size_t, int>>;
const Schedulers few = {{2, 1}, {3, 2}},
                 many = {{1, 1}, {1, 2}, {2, 1}, {2, 2}, {4, 1}, {4, 2}, {7, 1}};

OpenMP among(OpenMP executor, PieceRanks& ranks) {
  executor.ranks = &ranks;
  return executor;
}

template <class Real>
bool same_counts(const DistanceField<Real>& a, const DistanceField<Real>& b) {
  return a.statistics.supersteps == b.statistics.supersteps &&
         a.statistics.messages == b.statistics.messages &&
         a.statistics.message_bytes == b.statistics.message_bytes;
}

/// Does every rank get what one process gets, also in a second solve with the same memory?
template <class Domain>
void check_same_bits(const Domain& domain, const std::vector<PointSource>& sources,
                     const PropagateOptions& options, std::size_t size,
                     const Schedulers& schedulers = few) {
  using Real = typename Domain::Number;
  const auto alone = solve(pieces(2, size), domain, sources, options);
  REQUIRE(alone.statistics.sent_bytes == 0);
  for (const auto& [count, threads] : schedulers) {
    std::atomic<std::size_t> wrong{0}, sent{0};
    ThreadRanks(count).run([&, threads = threads](PieceRanks& ranks) {
      Workspace<Real> workspace;
      DistanceField<Real> field;
      for (int again = 0; again < 2; ++again) {
        solve(among(pieces(threads, size), ranks), domain, sources, options, workspace, field);
        wrong += !same_bits(alone, field) || !same_counts(alone, field) ||
                 field.error != alone.error || !(field.accuracy == alone.accuracy);
        sent += field.statistics.sent_bytes;
        if (again == 0)  // whatever the workspace did before
          solve(among(pieces(threads, 2 * size), ranks), domain, sources, options, workspace,
                field);
      }
    });
    INFO(count << " ranks, " << threads << " threads");
    CHECK(wrong == 0);
    CHECK((sent > 0) == (count > 1 && alone.statistics.supersteps > 0));
  }
}

}  // namespace

TEST_CASE("ranks: any number of ranks and threads has the bits of one process", "[threads]") {
  const auto mesh = jittered(20, 5).mesh<float>();
  check_same_bits(mesh, random_sources(mesh, 3, 1), at(Accuracy::fast()), 50, many);
  check_same_bits(mesh, random_sources(mesh, 3, 2), {}, 50, many);
}

TEMPLATE_TEST_CASE("ranks: labels on surfaces have the bits of one process", "[threads]", float,
                   double) {
  unsigned seed = 0;
  for (const Surface& s : surfaces()) {
    INFO("surface " << seed);
    const auto mesh = s.mesh<TestType>();
    const std::size_t count = ++seed % 2 == 0 ? 1 : 5;
    check_same_bits(mesh, random_sources(mesh, count, seed), at(Accuracy::fast()), 70);
  }
}

TEST_CASE("ranks: other rules, refraction, points inside of triangles", "[threads]") {
  const auto mesh = jittered(24, 3).mesh<float>();
  PropagateOptions options = at(Accuracy::fast());
  options.visibility = Visibility::centroid;
  check_same_bits(mesh, random_sources(mesh, 3, 1), options, 50);
  options.visibility = Visibility::saddles;
  check_same_bits(mesh, {PointSource::in(17, {0.2, 0.5, 0.3}), PointSource::at(3)}, options, 50);
  check_same_bits(mesh, {PointSource::in(17, {0.2, 0.5, 0.3})}, {}, 50);
  const auto refracting = two_speeds<float>(16);
  check_same_bits(refracting, random_sources(refracting, 2, 5), options, 30);
}

TEMPLATE_TEST_CASE("ranks: windows have the bits of one process", "[threads]", float, double) {
  unsigned seed = 0;
  for (const Surface& s : surfaces()) {
    INFO("surface " << seed);
    const auto mesh = s.mesh<TestType>();
    const std::size_t count = ++seed % 2 == 0 ? 1 : 4;
    check_same_bits(mesh, random_sources(mesh, count, seed), {}, 90);
    if (sizeof(TestType) == 8 && mesh.face_count() < 700)
      check_same_bits(mesh, random_sources(mesh, 2, seed), at(Accuracy::exact()), 90);
  }
}

TEST_CASE("ranks: a radius and a budget mean what they mean in one process", "[threads]") {
  const auto mesh = sphere(3).mesh<double>();
  const auto sources = random_sources(mesh, 2, 3);
  for (const Accuracy accuracy : {Accuracy::fast(), Accuracy::accurate(), Accuracy::exact()}) {
    PropagateOptions options = at(accuracy);
    options.radius = 0.7;
    check_same_bits(mesh, sources, options, 50);
    options = at(accuracy);
    for (const std::size_t most : {37u, 1500u}) {
      options.max_expansions = most;
      INFO("at most " << most);
      check_same_bits(mesh, sources, options, 50);
    }
  }
}

TEMPLATE_TEST_CASE("ranks: wireframes have the bits of one process", "[threads]", float, double) {
  for (unsigned seed = 1; seed <= 4; ++seed) {
    INFO("wires " << seed);
    const auto wires = random_wires(seed, 600, 500 * seed, seed).wireframe<TestType>();
    check_same_bits(wires, random_sources(wires, 1 + seed % 3, seed), {}, 40);
    PropagateOptions options;
    options.radius = 2;
    check_same_bits(wires, random_sources(wires, 2, seed), options, 40);
    options = {};
    options.max_expansions = 100 * seed;
    check_same_bits(wires, random_sources(wires, 3, seed), options, 40);
  }
}

TEST_CASE("ranks: what is one piece each solves for itself, and a solid", "[threads]") {
  const auto mesh = grid(8, 8).mesh<float>();
  check_same_bits(mesh, random_sources(mesh, 2, 1), {}, 1000);
  const auto wires = random_wires(1, 60, 100).wireframe<float>();
  check_same_bits(wires, random_sources(wires, 2, 1), {}, 1000);
  const auto solid = walled(8, 0.25).mesh<double>();
  for (const Accuracy accuracy : {Accuracy::fast(), Accuracy::accurate()})
    check_same_bits(solid, random_sources(solid, 2, 4), at(accuracy), 60);
}

TEST_CASE("ranks: one that fails is heard", "[threads]") {
  const auto mesh = sphere(4).mesh<float>();
  CHECK_THROWS_AS(ThreadRanks(3).run([&](PieceRanks& ranks) {
    PropagateOptions options;
    if (ranks.rank() == 1) options.radius = -1;
    (void)solve(among(pieces(1, 50), ranks), mesh, random_sources(mesh, 1, 1), options);
  }),
                  UsageError);
}

TEST_CASE("ranks: who has another domain, other sources or options is told", "[threads]") {
  const auto surface = jittered(20, 3), other = jittered(20, 4), larger = jittered(30, 3);
  const auto mesh = surface.mesh<float>(), moved = other.mesh<float>(), more = larger.mesh<float>();
  const auto solid = walled(8, 0.25).mesh<double>(), shaken = walled(8, 0.2).mesh<double>();
  const auto told = [](const auto& all, const auto& one, const PropagateOptions& others,
                       const std::vector<PointSource>& from, std::size_t size) -> std::string {
    std::atomic<int> ended{0};
    std::string what;
    try {
      ThreadRanks(3).run([&](PieceRanks& ranks) {
        const bool odd = ranks.rank() == 1;
        try {
          (void)solve(among(pieces(1, odd ? size : 60), ranks), odd ? one : all,
                      odd ? from : std::vector{PointSource::at(0)},
                      odd ? others : PropagateOptions());
        } catch (const UsageError&) {
          ++ended;
          throw;
        } catch (const InputError&) {
          ended += 10;
          throw;
        }
      });
    } catch (const std::exception& error) {
      what = error.what();
    }
    // All of them say so, and none goes on.
    return std::to_string(ended).append(" ").append(what.substr(0, what.find(':')));
  };
  const std::vector<PointSource> origin = {PointSource::at(0)};
  const std::string begin = "the ranks of one solve need the same ";
  CHECK(told(mesh, mesh, {}, origin, 60) == "0 ");
  CHECK(told(mesh, moved, {}, origin, 60) == "30 " + begin + "domain");
  CHECK(told(mesh, more, {}, origin, 60) == "30 " + begin + "domain");
  CHECK(told(solid, shaken, {}, origin, 60) == "30 " + begin + "domain");
  CHECK(told(mesh, mesh, {}, {PointSource::at(5)}, 60) == "3 " + begin + "sources");
  CHECK(told(mesh, mesh, {}, {PointSource::in(0, {0.5, 0.25, 0.25})}, 60) ==
        "3 " + begin + "sources");
  PropagateOptions options;
  options.radius = 0.5;
  CHECK(told(mesh, mesh, options, origin, 60) == "3 " + begin + "options");
  CHECK(told(mesh, mesh, at(Accuracy::fast()), origin, 60) == "3 " + begin + "options");
  CHECK(told(mesh, mesh, {}, origin, 70) == "3 " + begin + "options");
  // The same, built twice.
  const auto again = surface.mesh<float>();
  CHECK(told(mesh, again, {}, origin, 60) == "0 ");
}

}  // namespace plexway::testing::piece_ranks_test
