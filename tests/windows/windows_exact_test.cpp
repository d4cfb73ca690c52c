#include <catch2/catch.hpp>

#include <numbers>

#include <plexway/error.hpp>

#include "data/corner_domains.hpp"
#include "labels/cone.hpp"
#include "labels/unfolded_lines.hpp"
#include "windows/windows_solving.hpp"

namespace plexway::testing::windows_exact_test {

namespace {

/// In double, in any order: the same bits, and these are right.
void check_exact(const TriangleMesh<double>& mesh, const std::vector<PointSource>& sources,
                 const std::vector<double>& exact, double within = 1e-11) {
  Workspace<double> workspace;
  DistanceField<double> first, field;
  solve_windows(mesh, sources, Accuracy::exact(), {}, workspace, first);
  const Errors e = compare(first.distance, exact);
  CAPTURE(e.mean, e.max, e.below);
  CHECK(e.fits);
  CHECK(e.max <= within);
  for (const Schedule schedule : schedules) {
    PropagateOptions options;
    options.schedule = schedule;
    solve_windows(mesh, sources, Accuracy::exact(), options, workspace, field);
    CHECK(field.distance == first.distance);
  }
}

std::vector<double> least(std::vector<double> a, const std::vector<double>& b, double offset) {
  for (std::size_t i = 0; i < a.size(); ++i) a[i] = std::min(a[i], b[i] + offset);
  return a;
}

/// No shortest path from any of these vertices, or from inside their triangles, is longer.
double longest_of(const Surface& s, std::initializer_list<Index> from) {
  double longest = 0, edge = 0;
  for (const Index v : from)
    for (const double d : along_edges(s, v))
      if (d < 1e300) longest = std::max(longest, d);
  for (const auto& lengths : lengths_of(s))
    edge = std::max({edge, lengths[0], lengths[1], lengths[2]});
  return longest + edge;
}

/// Small surfaces of every kind, crooked at random.
std::vector<std::pair<const char*, Surface>> small_surfaces(unsigned seed) {
  std::mt19937 random(seed);
  const auto crumple = [&](Surface s, double by) {
    for (Position& p : s.positions)
      for (double& c : p) c += by * (uniform(random) - .5);
    return s;
  };
  return {
      {"sphere", crumple(sphere(1), .3)},
      {"crumpled sphere", crumple(sphere(1), 1.4)},
      {"grid", crumple(grid(4, 3), .25)},
      {"crumpled grid", crumple(grid(4, 3), 1.5)},
      {"polygon", random_polygon(5, 12, 30, seed)},
      {"tetrahedron", crumple(subdivide(tetrahedron()), .5)},
      {"cube", crumple(cube(2), .2)},
      {"moebius", crumple(moebius(7, 1), .3)},
      {"sheets", crumple(sheets(3, 2), .2)},
      {"bow tie", crumple(bow_tie(2), .3)},
      {"soup", soup(7, 9, seed)},
  };
}

}  // namespace

TEST_CASE("exact windows: small surfaces of every kind against all straight lines on them") {
#ifdef PLEXWAY_SANITIZED
  const unsigned seeds = 1;
#else
  const unsigned seeds = 8;
#endif
  for (unsigned seed = 1; seed <= seeds; ++seed)
    for (const auto& [what, s] : small_surfaces(seed)) {
      std::mt19937 random(seed);
      const Index v = s.faces[below(random, s.faces.size())][0], w = s.faces.back()[1];
      const Index f = below(random, s.faces.size());
      UnfoldedLines truth(s, longest_of(s, {v, w, s.faces[f][0]}));
      const auto mesh = s.mesh<double>();
      CAPTURE(what, seed, v, w, f);
      check_exact(mesh, {PointSource::at(v)}, truth.from(v), 1e-9);

      // Two sources, one inside a face, one of them late.
      const double a = .1 + .5 * uniform(random), b = (1 - a) * uniform(random);
      const std::array<double, 3> inside = {a, b, 1 - a - b};
      check_exact(mesh, {PointSource::in(f, inside)}, truth.from(f, inside), 1e-9);
      PointSource late = PointSource::at(w);
      late.offset = .3 * uniform(random);
      check_exact(mesh, {PointSource::in(f, inside), late},
                  least(truth.from(f, inside), truth.from(w), late.offset), 1e-9);

      // On an edge, from the side of either triangle.
      const std::array<double, 3> on_edge = {a, 1 - a, 0};
      check_exact(mesh, {PointSource::in(f, on_edge)}, truth.from(f, on_edge), 1e-9);
    }
}

TEST_CASE("exact windows: many sources inside faces, each in the light of others") {
  for (unsigned seed = 1; seed <= 12; ++seed) {
    std::mt19937 random(seed);
    const Surface s = seed % 2 ? random_polygon(6, 20, 60, seed) : grid(4, 4);
    const auto mesh = s.mesh<double>();
    std::vector<PointSource> sources;
    std::vector<double> exact(s.positions.size(), 1e300);
    for (int n = 0; n < 6; ++n) {
      const Index f = below(random, s.faces.size());
      const double a = .05 + .4 * uniform(random), b = .05 + .4 * uniform(random);
      const std::array<double, 3> inside = {a, b, 1 - a - b};
      sources.push_back(PointSource::in(f, inside));
      sources.back().offset = .2 * uniform(random);
      Position p{};
      for (std::size_t i = 0; i < 3; ++i)
        for (std::size_t c = 0; c < 3; ++c) p[c] += inside[i] * s.positions[s.faces[f][i]][c];
      exact = least(exact, straight(s, p), sources.back().offset);
    }
    CAPTURE(seed);
    check_exact(mesh, sources, exact);
  }
}

TEST_CASE("exact windows: corners, slits and holes of flat domains") {
  for (const samples::CornerDomain& domain : samples::corner_domains()) {
    const samples::Shape grid = domain.grid(50);
    CAPTURE(domain.name);
    check_exact(TriangleMesh<double>(grid.points, grid.faces), {PointSource::at(0)},
                domain.distances(grid.points), 1e-9);
  }
}

TEST_CASE("exact windows: a cube from one of its corners, and from any point") {
  const Surface s = cube(9);
  const std::vector<double> exact = by_rule(s, [](Position p) {
    std::sort(p.begin(), p.end());
    if (p[0] == 0) return std::hypot(p[1], p[2]);
    return std::min(std::hypot(1 + p[0], p[1]), std::hypot(1 + p[1], p[0]));
  });
  check_exact(s.mesh<double>(), {PointSource::at(s.nearest(0, 0, 0))}, exact);
}

TEST_CASE("exact windows: cones, convex and saddle") {
  for (const double turns : {0.3, 0.8, 1.0, 1.5, 2.7}) {
    const Index rings = 9, around = 30;
    const Cone<double> cone(rings, around, turns * 2 * std::numbers::pi);
    const auto mesh = cone.mesh();
    for (const Index source : {0u, 1u, 1 + 4 * around + 7, 1 + 8 * around + 20}) {
      std::vector<double> exact;
      for (Index v = 0; v < cone.radius.size(); ++v) exact.push_back(cone.distance(source, v));
      exact[source] = 0;
      CAPTURE(turns, source);
      check_exact(mesh, {PointSource::at(source)}, exact);
    }
  }
}

TEST_CASE("exact windows: flat surfaces of any triangle shape") {
  std::vector<Surface> flat = {grid(17, 13), grid(40, 40, 40, 2), grid(12, 12, 1.2e7, 12),
                               grid(12, 12, 12, 1.2e7),
                               renamed(grid(20, 20), 3, true, true).surface};
  for (unsigned seed = 1; seed <= 6; ++seed)
    flat.push_back(random_polygon(3 + seed, 100, 80 * (seed - 1), seed));
  for (const double by : {1e-3, 1e-6}) {
    flat.push_back(random_polygon(7, 120, 200, 9));
    for (Position& p : flat.back().positions) p[1] *= by;
  }
  for (const Surface& s : flat) {
    std::mt19937 random(7);
    for (int n = 0; n < 3; ++n) {
      const Index source = below(random, s.positions.size());
      CAPTURE(s.positions.size(), s.faces.size(), source);
      check_exact(s.mesh<double>(), {PointSource::at(source)}, straight(s, s.positions[source]));
    }
  }
}

TEST_CASE("exact windows: gluings that no positions have") {
  const double diagonal = std::sqrt(2.), third = 1. / 3;
  {
    const std::vector<Face> faces = {{0, 0, 0}, {0, 0, 0}};
    const std::vector<std::array<double, 3>> lengths = {{1, 1, diagonal}, {diagonal, 1, 1}};
    const std::vector<Face> across = {{4, 5, 3}, {2, 0, 1}};
    const TriangleMesh<double> torus(1, faces, lengths, across);
    CHECK(solve_windows(torus, {PointSource::at(0)}, Accuracy::exact())[0] == 0);
    CHECK(solve_windows(torus, {PointSource::in(0, {third, third, third})}, Accuracy::exact())[0] ==
          Approx(std::hypot(third, third)).epsilon(1e-14));
  }
  {
    const std::vector<Face> faces = {{0, 1, 1}}, across = {{2, none, 0}};
    const std::vector<std::array<double, 3>> lengths = {{2, 1, 2}};
    const TriangleMesh<double> cone(2, faces, lengths, across);
    CHECK(solve_windows(cone, {PointSource::at(1)}, Accuracy::exact()) ==
          std::vector<double>{2, 0});
  }
  {
    const double slope = std::sqrt(10.);
    const std::vector<Face> faces = {{0, 0, 1}, {0, 1, 1}}, across = {{none, 5, 3}, {2, none, 1}};
    const std::vector<std::array<double, 3>> lengths = {{1, 3, slope}, {slope, 1, 3}};
    const TriangleMesh<double> ring(2, faces, lengths, across);
    CHECK(solve_windows(ring, {PointSource::at(0)}, Accuracy::exact())[1] == Approx(3));
  }
}

}  // namespace plexway::testing::windows_exact_test
