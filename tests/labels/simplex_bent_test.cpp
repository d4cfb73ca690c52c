#include <catch2/catch.hpp>

#include "labels/simplex_testing.hpp"

namespace plexway::testing::simplex_bent_test {

namespace {

template <class Real, int N>
Errors holed(std::size_t n, Visibility visibility) {
  const HoledCube<N> cube(n);
  typename KuhnGrid<N>::Place at{};
  at[0] = n / 10;
  at[1] = n / 5;
  PropagateOptions options;
  options.visibility = visibility;
  const Index source = cube.grid.vertex(at);
  return compare(solve(cube.template complex<Real>(), PointSource::at(source), options),
                 cube.exact(source));
}

}  // namespace

TEMPLATE_TEST_CASE("around a hole distances add up as squares", "", float, double) {
  // sqrt(L^2 + dz^2 + dw^2), L the way around the square. What is wrong is what the plain step gets
  // wrong: centres see a little past the edge, and paths bend where edges are.
  const auto fits = [](const Errors& e, double mean, double max, double below) {
    CAPTURE(e.mean, e.max, e.below);
    CHECK(e.fits);
    CHECK(e.mean < mean);
    CHECK(e.max < max);
    CHECK(e.below > -below);
  };
  fits(holed<TestType, 2>(20, Visibility::centroid), 2e-4, 1e-2, 1e-2);
  fits(holed<TestType, 3>(10, Visibility::centroid), 1.2e-3, 5e-2, 2e-2);
  fits(holed<TestType, 3>(20, Visibility::centroid), 6e-4, 3e-2, 2e-2);
  fits(holed<TestType, 4>(10, Visibility::centroid), 1.2e-3, 8e-2, 2e-2);
}

TEMPLATE_TEST_CASE("upper bounds are no shorter than the way", "", float, double) {
  const double rounding = sizeof(TestType) == 4 ? 2e-6 : 1e-13;
  const auto fits = [&](const Errors& e) {
    CAPTURE(e.mean, e.max, e.below);
    CHECK(e.fits);
    CHECK(e.below > -rounding);
    CHECK(e.mean < .05);
    CHECK(e.max < .2);
  };
  fits(holed<TestType, 2>(20, Visibility::upper_bound));
  fits(holed<TestType, 3>(10, Visibility::upper_bound));
  fits(holed<TestType, 4>(8, Visibility::upper_bound));
}

TEMPLATE_TEST_CASE("there and back is the same way", "", float, double) {
  const HoledCube<3> cube(10);
  const auto domain = cube.complex<TestType>();
  const auto exact = cube.exact(0);
  std::vector<Index> ends;
  for (Index v = 0; v < exact.size(); v += 97)
    if (!std::isinf(exact[v])) ends.push_back(v);
  std::vector<std::vector<double>> d;
  for (const Index v : ends) d.push_back(solve(domain, PointSource::at(v)));
  double worst = 0, mean = 0;
  for (std::size_t i = 0; i < ends.size(); ++i)
    for (std::size_t j = 0; j < i; ++j) {
      const double e = std::abs(d[i][ends[j]] / d[j][ends[i]] - 1);
      worst = std::max(worst, e);
      mean += 2 * e / static_cast<double>(ends.size() * (ends.size() - 1));
    }
  CAPTURE(worst, mean);
  CHECK(worst < .06);
  CHECK(mean < 5e-3);
}

TEMPLATE_TEST_CASE("a simplicial field does not depend on numbering", "", float, double) {
  // Where several paths are as long, another one may be found first.
  const HoledCube<4> cube(6);
  const auto simplices = cube.grid.simplices([&](const auto& cell) {
    return cube.hole.covers(cube.grid.centre(cell)[0], cube.grid.centre(cell)[1]);
  });
  const std::vector<double> positions = cube.grid.positions();
  const auto d = solve(SimplicialComplex<TestType, 4>(positions, 4, simplices), PointSource::at(0));
  for (const unsigned seed : {1u, 2u, 3u}) {
    std::mt19937 random(seed);
    const auto shuffle = [&](auto& list) {
      for (std::size_t i = list.size(); i > 1; --i) std::swap(list[i - 1], list[below(random, i)]);
    };
    std::vector<Index> to(cube.grid.vertex_count());
    std::iota(to.begin(), to.end(), Index{0});
    shuffle(to);
    auto other = simplices;
    for (auto& s : other) {
      for (Index& v : s) v = to[v];
      shuffle(s);
    }
    shuffle(other);
    std::vector<double> moved(positions.size());
    for (std::size_t v = 0; v < to.size(); ++v)
      for (std::size_t a = 0; a < 4; ++a) moved[4 * to[v] + a] = positions[4 * v + a];
    const auto e = solve(SimplicialComplex<TestType, 4>(moved, 4, other), PointSource::at(to[0]));
    double worst = 0, mean = 0;
    for (std::size_t v = 0; v < to.size(); ++v) {
      REQUIRE(std::isinf(d[v]) == std::isinf(e[to[v]]));
      if (std::isinf(d[v]) || d[v] == 0) continue;
      worst = std::max(worst, std::abs(e[to[v]] / d[v] - 1));
      mean += std::abs(e[to[v]] / d[v] - 1) / static_cast<double>(to.size());
    }
    CAPTURE(seed, worst, mean);
    CHECK(worst < 2e-2);
    CHECK(mean < 5e-4);
  }
}

TEMPLATE_TEST_CASE("a power of two scales a simplicial field exactly", "", float, double) {
  const HoledCube<3> cube(6);
  const auto simplices = cube.grid.simplices();
  std::vector<double> positions = cube.grid.positions();
  auto d = solve(SimplicialComplex<TestType, 3>(positions, 3, simplices), PointSource::at(5));
  for (double& x : positions) x *= 0x1p-30;
  for (double& x : d) x *= 0x1p-30;
  CHECK(d == solve(SimplicialComplex<TestType, 3>(positions, 3, simplices), PointSource::at(5)));
}

}  // namespace plexway::testing::simplex_bent_test
