#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <map>
#include <random>
#include <vector>

#include <plexway/paths/path_field.hpp>
#include <plexway/solve.hpp>

#include "complexes/cube_distance.hpp"
#include "complexes/test_meshes.hpp"
#include "with_accuracy.hpp"

namespace plexway::testing::read_out_test {

namespace {

Position position(const Surface& s, const PointSource& at) {
  Position p = {0, 0, 0};
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t k = 0; k < 3; ++k)
      p[k] += at.barycentric[i] * s.positions[s.faces[at.simplex][i]][k];
  return p;
}

PointSource random_point(const Surface& s, std::mt19937& random) {
  double a = uniform(random), b = uniform(random);
  if (a + b > 1) a = 1 - a, b = 1 - b;
  return PointSource::in(below(random, s.faces.size()), {1 - a - b, a, b});
}

}  // namespace

TEST_CASE("between the vertices of a cube, level by level") {
  const Surface s = cube(12);
  const auto mesh = s.mesh<double>();
  PathField field(mesh, s.positions);
  std::mt19937 random(7);
  double mean[4] = {};
  constexpr int sources = 4, points = 2500;  // 10,000 points
  for (int n = 0; n < sources; ++n) {
    const PointSource source = random_point(s, random);
    const Position from = position(s, source);
    field.solve(Serial{}, source, by_labels());
    std::vector<PointSource> at;
    for (int i = 0; i < points; ++i) at.push_back(random_point(s, random));
    std::vector<double> exact;
    for (const PointSource& p : at) {
      Position q = position(s, p);
      for (double& x : q)  // onto the side, to the last bit
        if (std::abs(x - std::round(x)) < 1e-12) x = std::round(x);
      exact.push_back(cube_distance(from, q));
    }
    for (const ReadOut level :
         {ReadOut::linear, ReadOut::simplex, ReadOut::neighbours, ReadOut::star}) {
      const auto found = field.at(at, level);
      for (int i = 0; i < points; ++i) {
        const auto k = static_cast<std::size_t>(i);
        mean[static_cast<int>(level)] += std::abs(found[k] - exact[k]) / (sources * points);
        if (i % 100 == 0) CHECK(field.at(at[k], level) == found[k]);
      }
    }
  }
  // Measured: 1.4e-3, 4.9e-4, 2.0e-5, 7.5e-8.
  CHECK(mean[0] <= 3e-3);
  CHECK(mean[1] <= 1e-3);
  CHECK(mean[2] <= 4e-5);
  CHECK(mean[3] <= 2e-7);
}

TEST_CASE("across the edges of a cube") {
  const Surface s = cube(12);
  const auto mesh = s.mesh<double>();
  PathField field(mesh, s.positions);
  field.solve(Serial{}, PointSource::in(5, {0.2, 0.5, 0.3}), by_labels());
  std::map<std::pair<Index, Index>, std::pair<Index, std::size_t>> seen;
  double jump[4] = {};
  std::size_t edges = 0;
  for (Index f = 0; f < s.faces.size(); ++f)
    for (std::size_t i = 0; i < 3; ++i) {
      const Index a = s.faces[f][i], b = s.faces[f][(i + 1) % 3];
      const auto [other, fresh] = seen.try_emplace(std::minmax(a, b), f, i);
      if (fresh) continue;
      ++edges;
      const auto [g, j] = other->second;
      PointSource here{.simplex = f}, there{.simplex = g};
      here.barycentric[i] = 0.3, here.barycentric[(i + 1) % 3] = 0.7;
      there.barycentric[(j + 1) % 3] = 0.3, there.barycentric[j] = 0.7;
      if (s.faces[g][j] == a) std::swap(there.barycentric[j], there.barycentric[(j + 1) % 3]);
      for (const ReadOut level :
           {ReadOut::linear, ReadOut::simplex, ReadOut::neighbours, ReadOut::star})
        jump[static_cast<int>(level)] += std::abs(field.at(here, level) - field.at(there, level));
    }
  for (double& j : jump) j /= static_cast<double>(edges);
  CHECK(jump[0] < 1e-12);
  // Measured: 1.1e-3, 3.0e-5, 1.3e-6.
  CHECK(jump[1] < 2.5e-3);
  CHECK(jump[2] < 6e-5);
  CHECK(jump[3] < 3e-6);
}

TEST_CASE("directions away from the source") {
  const Surface s = grid(20, 20);
  const auto mesh = s.mesh<float>();
  PathField field(mesh, s.positions);
  // Merged light comes from beside its source.
  for (const auto& [accuracy, off] :
       {std::pair(Accuracy::fast(), 1e-4), {Accuracy::usual(), 2e-3}}) {
    field.solve(OpenMP{2}, PointSource::at(0), at(accuracy));
    const auto away = field.gradient();
    REQUIRE(away.size() == s.faces.size());
    for (std::size_t f = 0; f < s.faces.size(); ++f) {
      double x = 0, y = 0;
      for (const Index v : s.faces[f]) x += s.positions[v][0] / 3, y += s.positions[v][1] / 3;
      const double d = std::hypot(x, y);
      CHECK(away[f][0] == Approx(x / d).margin(off));
      CHECK(away[f][1] == Approx(y / d).margin(off));
      CHECK(away[f][2] == Approx(0).margin(1e-6));
    }
  }
}

TEST_CASE("what cannot be read out is said") {
  const Surface s = bow_tie(4);
  const auto mesh = s.mesh<double>();
  PathField field(mesh, s.positions);
  const double middle[] = {0.5, 0.25, 0.25};
  CHECK_THROWS_WITH(field.at(0, middle), Catch::Contains("before a solve"));
  field.solve(Serial{}, PointSource::at(0));
  CHECK_THROWS_WITH(field.at(1000000, middle), Catch::Contains("out of range"));
  CHECK(std::isfinite(field.at(0, middle)));
  field.solve(Serial{}, PointSource::at(0), {.visibility = Visibility::centroid});
  CHECK_THROWS_WITH(field.at(0, middle), Catch::Contains("saddles"));
  PathField bare(mesh);
  bare.solve(Serial{}, PointSource::at(0));
  CHECK_THROWS_WITH(bare.gradient(), Catch::Contains("positions"));
}

}  // namespace plexway::testing::read_out_test
