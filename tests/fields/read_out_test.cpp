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
#include "complexes/test_solids.hpp"
#include "complexes/test_wires.hpp"
#include "labels/solid_closed_forms.hpp"
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

namespace {

struct Asked {
  std::vector<PointSource> points;
  Solid places;  // where they are
};

Asked random_points(const Solid& s, std::size_t count) {
  std::mt19937 random(11);
  Asked asked;
  for (std::size_t n = 0; n < count; ++n) {
    std::array<double, 4> b;
    double sum = 0;
    for (double& x : b) sum += x = -std::log(1 - uniform(random));  // evenly over the simplex
    for (double& x : b) x /= sum;
    const Index t = below(random, s.tets.size());
    asked.points.push_back(PointSource::in(t, b));
    Position p = {0, 0, 0};
    for (std::size_t i = 0; i < 4; ++i)
      for (std::size_t k = 0; k < 3; ++k) p[k] += b[i] * s.positions[s.tets[t][i]][k];
    asked.places.positions.push_back(p);
  }
  return asked;
}

}  // namespace

TEST_CASE("inside a convex solid distances are exact but for linear ones") {
  const Solid s = solid_cube(8);
  const auto mesh = s.mesh<double>();
  const Asked asked = random_points(s, 2000);
  const PointSource source = PointSource::in(77, {0.1, 0.2, 0.3, 0.4});
  Position a = {0, 0, 0};
  for (std::size_t i = 0; i < 4; ++i)
    for (std::size_t k = 0; k < 3; ++k)
      a[k] += source.barycentric[i] * s.positions[s.tets[77][i]][k];
  std::vector<double> exact;
  for (const Position& p : asked.places.positions)
    exact.push_back(std::hypot(p[0] - a[0], p[1] - a[1], p[2] - a[2]));
  PathField field(mesh, s.positions);
  field.solve(Serial{}, source);
  CHECK(compare(field.at(asked.points, ReadOut::linear), exact).mean < 2e-2);
  for (const ReadOut level : {ReadOut::simplex, ReadOut::neighbours, ReadOut::star}) {
    const Errors e = compare(field.at(asked.points, level), exact);
    CHECK(e.mean < 1e-12);
    CHECK(e.below > -1e-12);
  }
  const auto away = field.gradient();
  for (std::size_t t = 0; t < s.tets.size(); ++t) {
    Position c = {0, 0, 0};
    for (const Index v : s.tets[t])
      for (std::size_t k = 0; k < 3; ++k) c[k] += s.positions[v][k] / 4;
    const double d = std::hypot(c[0] - a[0], c[1] - a[1], c[2] - a[2]);
    for (std::size_t k = 0; k < 3; ++k) CHECK(away[t][k] == Approx((c[k] - a[k]) / d).margin(1e-9));
  }
}

TEST_CASE("around a reflex edge distances are exact but for linear ones") {
  const Solid s = l_shape(12);
  const auto mesh = s.mesh<float>();
  const Asked asked = random_points(s, 4000);
  PathField field(mesh, s.positions);
  const Index source = s.nearest(0.9, 0.1, 0.2);
  const auto exact = around_l(asked.places, s.positions[source]);
  field.solve(OpenMP{2}, PointSource::at(source));
  CHECK(compare(field.at(asked.points, ReadOut::linear), exact).mean < 1.3e-2);  // 6.5e-3
  for (const ReadOut level : {ReadOut::simplex, ReadOut::neighbours, ReadOut::star}) {
    const Errors e = compare(field.at(asked.points, level), exact);
    CAPTURE(e.mean, e.max, e.below);
    CHECK(e.mean < 1e-6);
    CHECK(e.max < 2e-5);
  }
}

TEST_CASE("along the edges of a wireframe distances are exact") {
  // A square of sides 1, 1, 1 and 2, from a point of the long one.
  const std::array<Index, 2> edges[] = {{0, 1}, {1, 2}, {2, 3}, {3, 0}};
  const double lengths[] = {1, 1, 1, 2};
  const Wireframe<double> wire(4, edges, lengths);
  PathField field(wire);
  field.solve(Serial{}, PointSource::in(3, {0.75, 0.25}));  // 0.5 from vertex 3
  const auto at = [&](Index edge, double s) {
    return field.at(edge, {1 - s, s}, ReadOut::simplex);
  };
  CHECK(at(3, 0.25) == Approx(0).margin(1e-12));
  CHECK(at(3, 0.5) == Approx(0.5));
  CHECK(at(2, 0.25) == Approx(1.25));  // 0.75 from vertex 3
  CHECK(at(0, 0.5) == Approx(2));
  CHECK(at(1, 0.75) == Approx(1.75));
  CHECK(field.at(0, {0.5, 0.5}, ReadOut::linear) == Approx(2));
  CHECK_THROWS_WITH(field.gradient(), Catch::Contains("along edges compare the ends"));
}

TEST_CASE("linear distances are those of the last solve, others those of strings") {
  const Solid s = solid_cube(3);
  const auto mesh = s.mesh<float>();
  PathField field(mesh);
  field.solve(Serial{}, PointSource::at(40));
  field.solve(Serial{}, PointSource::at(0), {.visibility = Visibility::upper_bound});
  const double middle[] = {0.25, 0.25, 0.25, 0.25};
  double mean = 0;
  for (const Index v : s.tets[5]) mean += double(field.distances().distance[v]) / 4;
  CHECK(field.at(5, middle, ReadOut::linear) == Approx(mean));
  Position centre{};
  for (const Index v : s.tets[5])
    for (std::size_t k = 0; k < 3; ++k) centre[k] += s.positions[v][k] / 4;
  const Position& from = s.positions[0];
  CHECK(field.at(5, middle) ==
        Approx(std::hypot(centre[0] - from[0], centre[1] - from[1], centre[2] - from[2])));
}

TEST_CASE("a solid of lengths is read out by paths, or linearly") {
  const Solid s = solid_cube(3);
  const TetMesh<double> mesh(s.positions.size(), s.tets, s.lengths());
  PathField field(mesh);
  field.solve(Serial{}, PointSource::at(0));
  const double middle[] = {0.25, 0.25, 0.25, 0.25};
  double mean = 0;
  for (const Index v : s.tets[5]) mean += field.distances().distance[v] / 4;
  CHECK(field.at(5, middle, ReadOut::linear) == Approx(mean));
  Position centre{};
  for (const Index v : s.tets[5])
    for (std::size_t k = 0; k < 3; ++k) centre[k] += s.positions[v][k] / 4;
  const Position& from = s.positions[0];
  const double straight = std::hypot(centre[0] - from[0], centre[1] - from[1], centre[2] - from[2]);
  CHECK(field.at(5, middle) == Approx(straight).epsilon(1e-9));
}

}  // namespace plexway::testing::read_out_test
