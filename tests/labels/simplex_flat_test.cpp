#include <catch2/catch.hpp>

#include "labels/simplex_testing.hpp"

namespace plexway::testing::simplex_flat_test {

namespace {

/// Straight lines are found up to rounding; relative.
template <class Real>
constexpr double rounding = sizeof(Real) == 4 ? 1e-5 : 1e-14;

template <class Real, int N>
void check_cube(std::size_t n) {
  for (const unsigned seed : {0u, 1u, 2u}) {
    const KuhnGrid<N> grid = cube_grid<N>(n, seed);
    const auto domain = grid.template complex<Real>();
    typename KuhnGrid<N>::Place corner{}, inner, edge{};
    inner.fill(n / 2);
    inner[0] = n / 3;
    edge[N - 1] = n / 2;
    for (const auto& at : {corner, inner, edge}) {
      const Index source = grid.vertex(at);
      for (const Schedule schedule : schedules) {
        PropagateOptions options;
        options.schedule = schedule;
        const auto field = plexway::solve(Serial{}, domain, PointSource::at(source), options);
        const Errors e = compare(field.distance, straight(grid, source));
        CAPTURE(N, n, seed, source, name(options), e.max);
        CHECK(e.fits);
        CHECK(e.max < rounding<Real>);
        CHECK(field.distance[source] == 0);
        if (N == 2)  // strings are at vertices
          CHECK(field.statistics.reached_simplices == domain.simplex_count());
      }
    }
  }
}

/// The cube under a linear map into a space of six dimensions: convex, its simplices askew.
template <class Real, int N>
void check_parallelepiped(std::size_t n, unsigned seed) {
  const KuhnGrid<N> grid = cube_grid<N>(n, seed);
  std::mt19937 random(seed);
  double map[6][N];
  for (std::size_t r = 0; r < 6; ++r)
    for (std::size_t c = 0; c < N; ++c) map[r][c] = (r == c ? 2 : 0) + uniform(random) - .5;
  std::vector<double> positions;
  for (Index v = 0; v < grid.vertex_count(); ++v)
    for (const auto& row : map) {
      double x = 0;
      for (std::size_t c = 0; c < N; ++c) x += row[c] * grid.position(v)[c];
      positions.push_back(x);
    }
  const SimplicialComplex<Real, N> domain(positions, 6, grid.simplices());
  const Index source = grid.nearest([] {
    typename KuhnGrid<N>::Point p;
    p.fill(.3);
    return p;
  }());
  std::vector<double> exact;
  for (Index v = 0; v < grid.vertex_count(); ++v) {
    double sum = 0;
    for (std::size_t r = 0; r < 6; ++r)
      sum += std::pow(positions[6 * v + r] - positions[6 * source + r], 2);
    exact.push_back(std::sqrt(sum));
  }
  const Errors e = compare(solve(domain, PointSource::at(source)), exact);
  CAPTURE(N, seed, e.max);
  CHECK(e.fits);
  CHECK(e.max < 10 * rounding<Real>);
}

}  // namespace

TEMPLATE_TEST_CASE("in a square, a cube and a 4-cube distances are Euclidean", "", float, double) {
  check_cube<TestType, 2>(17);
  check_cube<TestType, 3>(8);
  check_cube<TestType, 4>(5);
}

TEMPLATE_TEST_CASE("a parallelepiped in a space of more dimensions is as good", "", float, double) {
  for (const unsigned seed : {3u, 4u}) {
    check_parallelepiped<TestType, 2>(12, seed);
    check_parallelepiped<TestType, 3>(6, seed);
    check_parallelepiped<TestType, 4>(4, seed);
  }
}

TEST_CASE("a 4-cube of nine cells a side is still exact") {
  const KuhnGrid<4> grid = cube_grid<4>(9, 7);
  const Errors e = compare(solve(grid.complex<double>(), PointSource::at(0)), straight(grid, 0));
  CAPTURE(e.max);
  CHECK(e.fits);
  CHECK(e.max < 1e-12);
}

TEMPLATE_TEST_CASE("a source inside a tetrahedron sees the whole cube", "", float, double) {
  const KuhnGrid<3> grid = cube_grid<3>(5, 9);
  const auto domain = grid.complex<TestType>();
  const auto simplices = grid.simplices();
  const std::array<double, 4> places[] = {
      {.1, .2, .3, .4}, {.25, .25, .25, .25}, {.5, 0, .5, 0}, {0, .2, .3, .5}, {0, 0, 1, 0}};
  for (const Index s : {Index{0}, Index{300}, Index{749}})
    for (const auto& b : places) {
      std::array<double, 3> at{};
      for (std::size_t i = 0; i < 4; ++i)
        for (std::size_t d = 0; d < 3; ++d) at[d] += b[i] * grid.position(simplices[s][i])[d];
      std::vector<double> exact;
      for (Index v = 0; v < grid.vertex_count(); ++v)
        exact.push_back(distance_between(grid.position(v), at));
      PointSource source = PointSource::in(s, b);
      source.offset = .5;
      for (double& x : exact) x = x < 1e-12 ? .5 : x + .5;
      const Errors e = compare(solve(domain, source), exact);
      CAPTURE(s, b[0], b[3], e.max);
      CHECK(e.fits);
      CHECK(e.max < rounding<TestType>);
    }
}

TEMPLATE_TEST_CASE("several sources share the 4-cube by nearness", "", float, double) {
  const KuhnGrid<4> grid = cube_grid<4>(4, 3);
  const auto domain = grid.complex<TestType>();
  std::vector<PointSource> sources = {PointSource::at(0), PointSource::at(333),
                                      PointSource::at(600)};
  sources[2].offset = .125;
  const auto field = plexway::solve(Serial{}, domain, sources);
  REQUIRE(field.label.size() == grid.vertex_count());
  double worst = 0, mean = 0;
  bool labels = true;
  for (Index v = 0; v < grid.vertex_count(); ++v) {
    double d[3], least = 1e9;
    for (std::size_t n = 0; n < 3; ++n) {
      d[n] =
          distance_between(grid.position(v), grid.position(sources[n].vertex)) + sources[n].offset;
      least = std::min(least, d[n]);
    }
    // Where cells of the diagram meet, a simplex has one source for all its vertices.
    const double error = (field.distance[v] - least) / std::max(least, .1);
    worst = std::max(worst, error);
    mean += error / static_cast<double>(grid.vertex_count());
    labels &= field.label[v] < 3 && d[field.label[v]] <= field.distance[v] * (1 + 1e-5) + 1e-6;
  }
  CHECK(worst < .08);
  CHECK(mean < .01);
  CHECK(labels);
  CHECK(field.distance[600] == .125);
}

TEMPLATE_TEST_CASE("simplices without volume carry distances on", "", float, double) {
  // A 4-cube pressed flat along its first axis: a cube, many times over.
  const KuhnGrid<4> grid = cube_grid<4>(4, 3);
  std::vector<double> positions = grid.positions();
  for (std::size_t i = 0; i < positions.size(); i += 4) positions[i] = 0;
  const SimplicialComplex<TestType, 4> domain(positions, 4, grid.simplices());
  CHECK(domain.summary().degenerate_simplices == domain.simplex_count());
  const auto at = [&](Index v) {
    return std::array{positions[4 * v + 1], positions[4 * v + 2], positions[4 * v + 3]};
  };
  std::vector<double> exact;
  for (Index v = 0; v < grid.vertex_count(); ++v) exact.push_back(distance_between(at(v), at(0)));
  const Errors e = compare(solve(domain, PointSource::at(0)), exact);
  CAPTURE(e.max);
  CHECK(e.fits);
  CHECK(e.max < rounding<TestType>);
}

}  // namespace plexway::testing::simplex_flat_test
