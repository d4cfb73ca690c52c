#include <catch2/catch.hpp>

#include <cstring>

#include <plexway/error.hpp>
#include <plexway/solve.hpp>

#include "complexes/test_wires.hpp"
#include "executors/parity.hpp"
#include "labels/simplex_testing.hpp"
#include "labels/solid_solving.hpp"
#include "with_accuracy.hpp"

namespace plexway::testing::fields_test {

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

}  // namespace plexway::testing::fields_test
