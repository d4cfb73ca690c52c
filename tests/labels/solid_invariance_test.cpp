#include <catch2/catch.hpp>

#include <algorithm>
#include <numeric>

#include "labels/solid_solving.hpp"

namespace plexway::testing::solid_invariance_test {

TEMPLATE_TEST_CASE("solids: scale and place do not matter", "", float, double) {
  const Solid s = l_shape(6);
  const Index source = s.nearest(1, 0, 0);
  const auto base = solve(s.mesh<TestType>(), PointSource::at(source));
  for (const double scale : {1e-6, 1e6}) {
    Solid scaled = s;
    for (Position& p : scaled.positions)
      for (double& x : p) x *= scale;
    auto d = solve(scaled.mesh<TestType>(), PointSource::at(source));
    for (double& x : d) x /= scale;
    const Errors e = compare(d, base);
    CHECK(e.max < (sizeof(TestType) == 4 ? 1e-5 : 1e-9));
  }
  Solid offset = s;
  for (Position& p : offset.positions)
    for (double& x : p) x += 1e6;
  const Errors e = compare(solve(offset.mesh<TestType>(), PointSource::at(source)), base);
  CHECK(e.max < 1e-4);
}

TEST_CASE("solids: order and orientation do not matter") {
  const Solid s = l_shape(6);
  const Index source = s.nearest(1, 0, 0);
  const auto base = solve(s.mesh<double>(), PointSource::at(source));
  std::mt19937 random(3);
  std::vector<Index> place(s.positions.size());
  std::iota(place.begin(), place.end(), Index{0});
  for (std::size_t i = place.size(); i > 1; --i) std::swap(place[i - 1], place[below(random, i)]);
  Solid mixed = s;
  for (std::size_t v = 0; v < place.size(); ++v) mixed.positions[place[v]] = s.positions[v];
  for (Tet& t : mixed.tets) {
    for (Index& v : t) v = place[v];
    std::swap(t[below(random, 4)], t[below(random, 4)]);
  }
  for (std::size_t i = mixed.tets.size(); i > 1; --i)
    std::swap(mixed.tets[i - 1], mixed.tets[below(random, i)]);
  const auto found = solve(mixed.mesh<double>(), PointSource::at(place[source]));
  std::vector<double> back(found.size());
  for (std::size_t v = 0; v < place.size(); ++v) back[v] = found[place[v]];
  CHECK(compare(back, base).max < 1e-9);
}

TEST_CASE("solids: there and back") {
  const Solid s = l_shape(8);
  const Index a = s.nearest(1, 0, .25), b = s.nearest(0, 1, .75);
  const auto mesh = s.mesh<double>();
  CHECK(solve(mesh, PointSource::at(a))[b] ==
        Approx(solve(mesh, PointSource::at(b))[a]).epsilon(1e-9));
}

TEST_CASE("solids: no path is longer than along edges") {
  for (const Solid& s : {l_shape(6), walled(8), edge_touch(6)}) {
    const auto bound = along_edges(s, 0);
    const auto found = solve(s.mesh<double>(), PointSource::at(0));
    for (std::size_t v = 0; v < bound.size(); ++v) CHECK(found[v] <= bound[v] * (1 + 1e-12));
  }
}

TEST_CASE("solids: tetrahedra without volume keep between the straight line and the edges") {
  // A cube pressed onto a line or flat, or its lowest layer of cells.
  std::mt19937 random(8);
  for (const int axes : {1, 2, 3})
    for (int round = 0; round < 4; ++round) {
      Solid s = solid_cube(4, 0);
      for (Position& p : s.positions) {
        const bool low = p[2] < .3;
        for (double& x : p) x += (axes == 3 ? .06 : .3) * (uniform(random) - .5);
        if (axes == 1) p[1] = 0;
        if (axes < 3 || low) p[2] = 0;
      }
      const auto source = static_cast<Index>(below(random, s.positions.size()));
      const auto bound = along_edges(s, source);
      const auto found = solve(s.mesh<double>(), PointSource::at(source));
      for (std::size_t v = 0; v < bound.size(); ++v) {
        const Position &p = s.positions[v], &q = s.positions[source];
        CAPTURE(axes, round, v);
        CHECK(found[v] <= bound[v] * (1 + 1e-12));
        CHECK(found[v] >= std::hypot(p[0] - q[0], p[1] - q[1], p[2] - q[2]) * (1 - 1e-9));
      }
    }
}

}  // namespace plexway::testing::solid_invariance_test
