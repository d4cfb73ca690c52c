#include <catch2/catch.hpp>

#include <plexway/error.hpp>

#include "labels/simplex_testing.hpp"

namespace plexway::testing::serial_simplicial_test {

namespace {

template <class Domain>
void refused(const Domain& domain, const PointSource& source,
             const PropagateOptions& options = {}) {
  CHECK_THROWS_AS(plexway::solve(Serial{}, domain, source, options), UsageError);
}

/// Simplices thrown together, with lengths that mostly fit no flat simplex.
template <int N>
SimplicialComplex<double, N> thrown_together(unsigned seed) {
  std::mt19937 random(seed);
  const std::size_t vertices = N + 2 + below(random, 8), count = 3 + below(random, 60);
  const double wild = std::pow(10, 6 * uniform(random)), zero = uniform(random) < .5 ? .3 : 0;
  std::vector<std::array<Index, N + 1>> simplices;
  std::vector<std::array<double, N*(N + 1) / 2>> lengths;
  std::map<std::pair<Index, Index>, double> drawn;  // of each edge
  while (simplices.size() < count) {
    std::array<Index, N + 1> corners;
    for (Index& v : corners) v = below(random, vertices);
    auto sorted = corners;
    std::sort(sorted.begin(), sorted.end());
    if (std::adjacent_find(sorted.begin(), sorted.end()) != sorted.end()) continue;
    simplices.push_back(corners);
    auto& row = lengths.emplace_back();
    for (std::size_t j = 1, n = 0; j <= N; ++j)
      for (std::size_t i = 0; i < j; ++i) {
        const auto [known, first] = drawn.try_emplace(std::minmax(corners[i], corners[j]), 0);
        if (first && uniform(random) >= zero) known->second = std::pow(wild, uniform(random));
        row[n++] = known->second;
      }
  }
  return {vertices, simplices, lengths};
}

template <int N>
void check_end(unsigned seed) {
  const auto domain = thrown_together<N>(seed);
  for (const Schedule schedule : schedules) {
    PropagateOptions options;
    options.schedule = schedule;
    const auto field = plexway::solve(Serial{}, domain, PointSource::at(0), options);
    CAPTURE(N, seed, name(options), field.statistics.updates);
    CHECK(field.complete);
    CHECK(field.statistics.updates < 400000);
    bool fine = true;
    for (const double d : field.distance) fine &= d >= 0;
    CHECK(fine);
  }
}

}  // namespace

TEMPLATE_TEST_CASE("simplicial sources and options that make no sense are refused", "", float,
                   double) {
  const auto solid = cube_grid<3>(2).complex<TestType>();
  const auto flat = cube_grid<2>(2).complex<TestType>();
  const auto four = cube_grid<4>(1).complex<TestType>();
  const double nothing = std::numeric_limits<double>::quiet_NaN();
  CHECK_THROWS_AS(plexway::solve(Serial{}, solid, std::span<const PointSource>{}), UsageError);
  refused(solid, {});
  refused(solid, PointSource::at(27));
  refused(solid, PointSource::in(48, {.25, .25, .25, .25}));
  refused(solid, PointSource::in(0, {.25, .25, .25, .5}));
  refused(solid, PointSource::in(0, {.5, .5, .25, -.25}));
  refused(solid, PointSource::in(0, {nothing, .5, .5, 0.}));
  refused(flat, PointSource::in(0, {.25, .25, .25, .25}));
  refused(four, PointSource::in(0, {.25, .25, .25, .25}));
  CHECK_THROWS_WITH(plexway::solve(Serial{}, four, PointSource::in(0, {1., 0., 0., 0.})),
                    Catch::Matchers::Contains("vertex"));
  for (const double offset : {-1e-9, nothing}) refused(solid, {.vertex = 0, .offset = offset});
  refused(solid, PointSource::at(0), {.step = 0});
  refused(solid, PointSource::at(0), {.radius = -1});
}

TEMPLATE_TEST_CASE("a 4-cube within a radius", "", float, double) {
  const auto grid = cube_grid<4>(6);
  const auto domain = grid.complex<TestType>();
  const auto exact = straight(grid, 0);
  for (const double radius : {0., .3, .8, 3.}) {
    const auto field = plexway::solve(Serial{}, domain, PointSource::at(0), {.radius = radius});
    bool right = field.distance[0] == 0;
    for (std::size_t v = 0; v < exact.size(); ++v) {
      if (exact[v] < .999 * radius) right &= std::abs(field.distance[v] - exact[v]) < 1e-5;
      if (exact[v] > 1.001 * radius) right &= std::isinf(field.distance[v]);
    }
    CAPTURE(radius);
    CHECK(right);
    if (radius < .5) CHECK(2 * field.statistics.reached_simplices < domain.simplex_count());
  }
}

TEST_CASE("a simplicial propagation can be bounded, watched and cancelled") {
  const auto grid = cube_grid<4>(8);
  const auto domain = grid.complex<float>();
  const auto part = plexway::solve(Serial{}, domain, PointSource::at(0), {.max_expansions = 1000});
  CHECK_FALSE(part.complete);
  CHECK(part.statistics.expansions == 1000);
  CHECK(std::isinf(part.distance.back()));
  PropagateOptions options;
  int calls = 0;
  options.progress = [&](const Progress& p) {
    ++calls;
    return p.simplices == domain.simplex_count() && p.distance <= 2;
  };
  CHECK(plexway::solve(Serial{}, domain, PointSource::at(0), options).complete);
  CHECK(calls > 0);
  options.progress = [](const Progress&) { return false; };
  CHECK_THROWS_AS(plexway::solve(Serial{}, domain, PointSource::at(0), options), Cancelled);
}

TEMPLATE_TEST_CASE("solving a simplicial domain again gives the same bits", "", float, double) {
  const HoledCube<4> cube(5);
  const auto domain = cube.complex<TestType>();
  Workspace<TestType> workspace;
  const PointSource one[] = {PointSource::at(0)};
  const PointSource two[] = {PointSource::at(1295), PointSource::at(7)};
  check_again(workspace, domain, one, two);
  CHECK(workspace.bytes() > domain.vertex_count() * 100);
}

TEMPLATE_TEST_CASE("parts that only touch are reached through their vertices", "", float, double) {
  // Two cubes that share one vertex, and a third that shares an edge with the second.
  const KuhnGrid<3> grid({3, 2, 2}, {1, 1, 1});
  const auto domain = grid.complex<TestType>([](const auto& c) {
    const bool first = c[0] == 0 && c[1] == 0 && c[2] == 0;
    const bool second = c[0] == 1 && c[1] == 1 && c[2] == 1;
    const bool third = c[0] == 2 && c[1] == 0 && c[2] == 1;
    return !first && !second && !third;
  });
  CHECK(domain.summary().components == 1);
  const auto d = solve(domain, PointSource::at(0));
  CHECK(d[grid.vertex({1, 1, 1})] == Approx(std::sqrt(3)).epsilon(1e-6));
  CHECK(d[grid.vertex({2, 2, 2})] == Approx(2 * std::sqrt(3)).epsilon(1e-6));
  // Over the shared edge (2, 1, 1) - (2, 1, 2): by one of its ends.
  CHECK(d[grid.vertex({3, 0, 1})] == Approx(std::sqrt(3) + 1 + std::sqrt(2)).epsilon(1e-6));
  CHECK(std::isinf(d[grid.vertex({0, 2, 2})]));
}

TEST_CASE("impossible lengths end and reach everything") {
  std::mt19937 random(5);
  const KuhnGrid<3> grid = cube_grid<3>(6);
  const auto simplices = grid.simplices();
  for (const double wild : {1., 30., 1e6}) {
    std::vector<std::array<double, 6>> lengths;
    std::map<std::pair<Index, Index>, double> drawn;  // of each edge
    for (const auto& corners : simplices) {
      auto& row = lengths.emplace_back();
      for (std::size_t j = 1, n = 0; j < 4; ++j)
        for (std::size_t i = 0; i < j; ++i) {
          const auto [known, first] = drawn.try_emplace(std::minmax(corners[i], corners[j]), 0);
          if (first) known->second = std::pow(wild, uniform(random)) * (.1 + uniform(random));
          row[n++] = known->second;
        }
    }
    const SimplicialComplex<float, 3> domain(grid.vertex_count(), simplices, lengths);
    CHECK(domain.summary().violated_simplices > 0);
    for (const Visibility visibility : {Visibility::centroid, Visibility::upper_bound}) {
      const auto field =
          plexway::solve(Serial{}, domain, PointSource::at(0), {.visibility = visibility});
      CAPTURE(wild, field.statistics.updates);
      CHECK(field.complete);
      CHECK(field.statistics.reached_simplices == domain.simplex_count());
      bool finite = true;
      for (const float d : field.distance) finite &= d >= 0 && d < 1e30F;
      CHECK(finite);
    }
  }
}

TEST_CASE("lengths that would shorten a path for ever do not") {
  // The first two went on without end before updates had to gain more and more.
  check_end<2>(71565);
  check_end<3>(91358);
  for (unsigned seed = 1; seed <= 300; ++seed) {
    check_end<2>(seed);
    check_end<3>(seed);
    check_end<4>(seed);
  }
}

}  // namespace plexway::testing::serial_simplicial_test
