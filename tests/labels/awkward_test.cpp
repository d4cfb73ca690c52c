#include <catch2/catch.hpp>

#include <numeric>

#include "labels/awkward_surfaces.hpp"
#include "labels/solving.hpp"

namespace plexway::testing::awkward_test {

namespace {

/// Which vertices hang together, over edges and vertices alike.
std::vector<Index> pieces(const Surface& s) {
  std::vector<Index> parent(s.positions.size());
  std::iota(parent.begin(), parent.end(), Index{0});
  const auto find = [&](Index v) {
    while (parent[v] != v) v = parent[v] = parent[parent[v]];
    return v;
  };
  for (const Face& f : s.faces)
    for (std::size_t i = 1; i < 3; ++i) parent[find(f[0])] = find(f[i]);
  for (Index v = 0; v < parent.size(); ++v) parent[v] = find(v);
  return parent;
}

/// Finite exactly where a path leads, never NaN, 0 at the source.
template <class Real>
void check_reach(const Surface& s, Index source) {
  const auto mesh = s.mesh<Real>();
  const std::vector<Index> piece = pieces(s);
  for (const Visibility visibility : visibilities)
    for (const Schedule schedule : schedules)
      for (const bool vectorised : {true, false}) {
        PropagateOptions options;
        options.visibility = visibility;
        options.schedule = schedule;
        options.vectorised = vectorised;
        const std::vector<double> d = solve(mesh, PointSource::at(source), options);
        CAPTURE(name(options), source, s.positions.size(), s.faces.size());
        bool right = true;
        for (Index v = 0; v < d.size(); ++v)
          right &=
              !std::isnan(d[v]) && d[v] >= 0 && std::isfinite(d[v]) == (piece[v] == piece[source]);
        CHECK(right);
        CHECK(d[source] == 0);
      }
}

}  // namespace

TEMPLATE_TEST_CASE("soups of triangles: finite exactly where a path leads", "", float, double) {
#ifdef PLEXWAY_SANITIZED
  const unsigned seeds = 10;
#else
  const unsigned seeds = 60;
#endif
  each_soup(seeds, 60, check_reach<TestType>);
}

TEMPLATE_TEST_CASE("crumpled grids: finite everywhere", "", float, double) {
#ifdef PLEXWAY_SANITIZED
  const unsigned seeds = 4;
#else
  const unsigned seeds = 20;
#endif
  each_crumpled(seeds, 14, check_reach<TestType>);
}

TEMPLATE_TEST_CASE("zero-area triangles and zero-length edges", "", float, double) {
  each_flat(check_reach<TestType>);
}

TEMPLATE_TEST_CASE("on a line distances are along it", "", float, double) {
  Surface s = grid(8, 3);
  for (Position& p : s.positions) p[1] = 0;
  const Errors e = compare(solve(s.mesh<TestType>(), PointSource::at(0)), straight(s, {0, 0, 0}));
  CHECK(e.max < 1e-5);
}

TEMPLATE_TEST_CASE("a point has no distances", "", float, double) {
  Surface s;
  for (int i = 0; i < 4; ++i) s.add(1, 2, 3);
  s.quad(0, 1, 2, 3);
  for (const double d : solve(s.mesh<TestType>(), PointSource::at(1))) {
    CHECK(d >= 0);
    CHECK(d < 1e-25);
  }
}

TEMPLATE_TEST_CASE("lengths that no triangle has", "", float, double) {
  std::mt19937 random(12);
  const Surface s = grid(9, 9);
  for (int n = 0; n < 20; ++n) {
    std::vector<std::array<double, 3>> lengths = lengths_of(s);
    std::map<std::pair<Index, Index>, double> length;
    for (std::size_t f = 0; f < s.faces.size(); ++f)
      for (std::size_t i = 0; i < 3; ++i)
        lengths[f][i] = length
                            .try_emplace(std::minmax(s.faces[f][i], s.faces[f][(i + 1) % 3]),
                                         uniform(random) < .1 ? 0 : uniform(random))
                            .first->second;
    const TriangleMesh<TestType> mesh(s.positions.size(), s.faces, lengths);
    for (const Visibility visibility : visibilities) {
      PropagateOptions options;
      options.visibility = visibility;
      options.schedule = Schedule::priority;
      bool fine = true;
      for (const double d : solve(mesh, PointSource::at(50), options)) fine &= d >= 0 && d < 1e3;
      CAPTURE(n, name(options));
      CHECK(fine);
    }
  }
}

TEMPLATE_TEST_CASE("an edge without length between two of different length", "", float, double) {
  const std::vector<Face> faces = {{0, 1, 2}, {2, 1, 3}};
  const std::vector<std::array<double, 3>> lengths = {{1, 0, .4}, {0, .7, .9}};
  const TriangleMesh<TestType> mesh(4, faces, lengths);
  for (const Visibility visibility : visibilities) {
    PropagateOptions options;
    options.visibility = visibility;
    options.schedule = Schedule::priority;
    CAPTURE(name(options));
    for (const double d : solve(mesh, PointSource::at(0), options)) CHECK(d <= 3);
  }
}

TEMPLATE_TEST_CASE("other components and unreferenced vertices are out of reach", "", float,
                   double) {
  Surface s = grid(6, 6);
  const Index lone = s.add(.5, .5), a = s.add(5, 0), b = s.add(6, 0), c = s.add(5, 1);
  s.triangle(a, b, c);
  check_reach<TestType>(s, 10);
  check_reach<TestType>(s, b);
  check_reach<TestType>(s, lone);
}

}  // namespace plexway::testing::awkward_test
