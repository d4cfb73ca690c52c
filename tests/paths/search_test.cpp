#include <array>
#include <catch2/catch.hpp>
#include <cmath>
#include <limits>
#include <numbers>
#include <string>
#include <vector>

#include <plexway/error.hpp>
#include <plexway/io/triangles.hpp>
#include <plexway/paths/bounded_search.hpp>
#include <plexway/paths/path_search.hpp>
#include <plexway/paths/shorten.hpp>

#include "exact_data.hpp"
#include "labels/solving.hpp"
#include "paths/path_testing.hpp"
#include "with_accuracy.hpp"

namespace plexway::testing::search_test {

namespace {

// A search asks for one label after the other, so executors that take many at once have none.
struct AllAtOnce {};
template <class Executor>
concept Searches = requires(PathSearch<float> search, Executor executor, PointSource p) {
  search.find(executor, p, p);
};
static_assert(Searches<Serial>);
static_assert(!Searches<AllAtOnce>);

Surface hills(Index n) {
  Surface s = grid(n, n);
  for (Position& p : s.positions) p[2] = 0.08 * std::sin(9 * p[0]) * std::cos(7 * p[1]);
  return s;
}

}  // namespace

TEMPLATE_TEST_CASE("a search finds the path that a full solve does, and looks at little", "", float,
                   double) {
  const Surface s = hills(60);
  const auto mesh = s.mesh<TestType>();
  PathField field(mesh, s.positions);
  PathSearch<TestType> search(mesh, s.positions), nearest_first(mesh);
  std::mt19937 random(3);
  double shares = 0;
  int pairs = 0;
  for (int k = 0; k < 8; ++k) {
    const Index source = below(random, s.positions.size());
    const auto& full = field.solve(Serial{}, PointSource::at(source));
    const double all = static_cast<double>(full.statistics.expansions);
    for (int i = 0; i < 10; ++i) {
      const Index target = below(random, s.positions.size());
      if (apart(s.positions[source], s.positions[target]) > 0.7) continue;
      const Path path = field.trace(target);
      for (PathSearch<TestType>* one : {&search, &nearest_first}) {
        const SearchResult found =
            one->find(Serial{}, PointSource::at(source), PointSource::at(target));
        CAPTURE(source, target, one == &search);
        REQUIRE(found.paths.size() == 1);
        CHECK(found.complete);
        CHECK(found.paths[0].length == Approx(path.length).epsilon(1e-4).margin(1e-12));
        // Labels are as exact as their rule, which depends on the order they come in.
        CHECK(found.distance[0] == Approx(path.length).epsilon(1.5e-2).margin(1e-6));
        if (one == &search) shares += static_cast<double>(found.statistics.expansions) / all;
      }
      ++pairs;
    }
  }
  CAPTURE(shares / pairs);
  CHECK(shares <= 0.07 * pairs);
}

TEST_CASE("a search on scans finds the path of the full solve and looks at a few hundredths") {
  std::size_t pairs = 0, apart = 0;
  double shares = 0, most = 0;
  for (const char* name : {"spot", "fandisk", "rocker-arm", "camelhead", "beetle_car"}) {
    const auto file = exact_file("surfaces", std::string(name) + ".obj");
    if (file.empty()) continue;
    const io::Triangles t = io::read_triangles(file);
    const TriangleMesh<float> mesh(t.positions, t.triangles);
    PathField field(mesh, t.positions);
    PathSearch<float> search(mesh, t.positions);
    std::mt19937 random(7);
    for (int k = 0; k < 3; ++k) {
      const Index source = below(random, t.positions.size());
      const auto& full = field.solve(Serial{}, PointSource::at(source));
      float farthest = 0;
      for (const float d : full.distance)
        if (std::isfinite(d)) farthest = std::max(farthest, d);
      for (int i = 0; i < 10;) {
        const Index target = below(random, t.positions.size());
        if (target == source || !(full.distance[target] <= farthest / 2)) continue;
        ++i, ++pairs;
        const auto found = search.find(Serial{}, PointSource::at(source), PointSource::at(target));
        const double share = static_cast<double>(found.statistics.expansions) /
                             static_cast<double>(full.statistics.expansions);
        shares += share, most = std::max(most, share);
        const double off = std::abs(found.paths[0].length / field.trace(target).length - 1);
        apart += off > 1e-4;
        CAPTURE(name, source, target);
        CHECK(off <= 4e-4);
      }
    }
  }
  CAPTURE(pairs, apart, shares, most);
  CHECK(shares <= 0.05 * static_cast<double>(pairs));
  CHECK(static_cast<double>(apart) <= 0.015 * static_cast<double>(pairs));
}

TEST_CASE("a search for several targets, some of them out of reach") {
  Surface s = grid(20, 20);
  const Index island = s.add(3, 3);
  s.add(4, 3);
  s.add(3, 4);
  s.triangle(island, island + 1, island + 2);
  const auto mesh = s.mesh<float>();
  PathSearch<float> search(mesh, s.positions);
  const std::vector<PointSource> sources = {PointSource::at(0), PointSource::in(700, {.2, .2, .6})};
  const std::vector<PointSource> targets = {PointSource::at(60), PointSource::at(island),
                                            PointSource::in(333, {.3, .3, .4}), PointSource::at(0)};
  const Position from = place(s.positions, s.faces[700], sources[1].barycentric);
  for (int again = 0; again < 2; ++again) {
    const SearchResult found = search.find(Serial{}, sources, targets);
    REQUIRE(found.paths.size() == 4);
    CHECK(found.paths[1].points.empty());
    CHECK(std::isinf(found.paths[1].length));
    for (const std::size_t k : {0u, 2u, 3u}) {
      const Position at = targets[k].vertex != none
                              ? s.positions[targets[k].vertex]
                              : place(s.positions, s.faces[333], targets[k].barycentric);
      CAPTURE(k);
      check_path(found.paths[k], s.positions, s.faces);
      CHECK(
          found.paths[k].length ==
          Approx(std::min(apart(at, s.positions[0]), apart(at, from))).epsilon(1e-9).margin(1e-12));
    }
  }
  SearchOptions few;
  few.max_expansions = 5;
  CHECK_FALSE(search.find(Serial{}, sources, targets, few).complete);
  CHECK_THROWS_AS(search.find(Serial{}, sources, std::span<const PointSource>()), UsageError);
  CHECK_THROWS_AS(search.find(Serial{}, PointSource::at(0), PointSource::at(9999)), UsageError);
}

TEST_CASE("a search refuses straight lines that are no lower bound") {
  // A metric in which the right half is three times as short as its positions.
  const Surface s = grid(24, 24);
  auto lengths = lengths_of(s);
  std::vector<Position> squeezed = s.positions;
  for (auto& row : lengths)
    for (double& l : row) l *= 0.5;
  const TriangleMesh<float> mesh(s.positions.size(), s.faces, lengths);
  CHECK_THROWS_WITH(PathSearch<float>(mesh, s.positions), Catch::Contains("0.5"));
  CHECK_THROWS_AS(PathSearch<float>(mesh, std::span(squeezed).first(3)), UsageError);
  PathSearch<float> scaled(mesh, s.positions, 0.5), plain(mesh);
  const PointSource from = PointSource::at(s.nearest(0.1, 0.2)),
                    to = PointSource::at(s.nearest(.5, .4));
  const auto found = scaled.find(Serial{}, from, to), all = plain.find(Serial{}, from, to);
  const double exact = 0.5 * apart(s.positions[from.vertex], s.positions[to.vertex]);
  CHECK(found.distance[0] == Approx(exact).epsilon(1e-5));
  CHECK(all.distance[0] == Approx(exact).epsilon(1e-5));
  CHECK(found.statistics.expansions < all.statistics.expansions);

  // A heuristic of one's own: here half of the exact distance to go.
  SearchOptions guided;
  guided.heuristic = [&](Index v) { return 0.25 * apart(s.positions[v], s.positions[to.vertex]); };
  const auto by_hand = plain.find(Serial{}, from, to, guided);
  CHECK(by_hand.distance[0] == Approx(exact).epsilon(1e-5));
  CHECK(by_hand.statistics.expansions < all.statistics.expansions);
}

TEMPLATE_TEST_CASE("a bounded search is the full solve, cut off", "", float, double) {
  std::vector<Surface> surfaces = {hills(30), bow_tie(8), sheets(4, 8), moebius(30, 4),
                                   soup(60, 200, 4)};
  std::mt19937 random(5);
  for (std::size_t k = 0; k < surfaces.size(); ++k) {
    const Surface& s = surfaces[k];
    const auto mesh = s.mesh<TestType>();
    BoundedSearch<TestType> search(mesh);
    for (int round = 0; round < 12; ++round) {
      std::vector<PointSource> sources = {anywhere(s.faces, random)};
      if (round % 2) sources.push_back(PointSource::at(s.faces[below(random, s.faces.size())][0]));
      sources[0].offset = round % 3 ? 0 : 0.05;
      PropagateOptions options = by_labels();
      options.radius = 0.1 + 0.3 * uniform(random);
      const auto cut =
          plexway::solve(Serial{}, mesh, std::span<const PointSource>(sources), options);
      const auto full =
          plexway::solve(Serial{}, mesh, std::span<const PointSource>(sources), by_labels());
      const auto& found = search.find(Serial{}, sources, options, true);
      CAPTURE(k, round);
      CHECK(found.complete);
      CHECK(found.simplices.size() == found.statistics.reached_simplices);
      std::vector<double> sparse(s.positions.size(), std::numeric_limits<double>::infinity());
      bool once = true;
      for (const auto& [vertex, distance, label] : found.vertices) {
        once = once && std::isinf(sparse[vertex]) && label < sources.size();
        sparse[vertex] = static_cast<double>(distance);
      }
      CHECK(once);
      double off = 0, off_full = 0;
      for (std::size_t v = 0; v < sparse.size(); ++v) {
        const double d = static_cast<double>(cut.distance[v]);
        REQUIRE(std::isinf(sparse[v]) == std::isinf(d));
        if (std::isinf(d)) continue;
        off = std::max(off, std::abs(sparse[v] - d));
        off_full = std::max(off_full, sparse[v] / static_cast<double>(full.distance[v]) - 1);
      }
      CHECK(off <= 2e-7);
      if (k < 2) CHECK(off_full <= 5e-7);
    }
  }
}

TEST_CASE("a bounded search says what it does not do") {
  const Surface s = grid(4, 4);
  const auto mesh = s.mesh<float>();
  BoundedSearch<float> search(mesh);
  CHECK(search.find(Serial{}, PointSource::at(0), 0.0).vertices.size() == 1);
  CHECK(search.find(Serial{}, PointSource::at(0), std::numeric_limits<double>::infinity())
            .vertices.size() == s.positions.size());
  CHECK(search.find(Serial{}, PointSource::at(3), 0.3).simplices.empty());
  PropagateOptions options;
  options.visibility = Visibility::centroid;
  const PointSource source = PointSource::at(0);
  CHECK_THROWS_AS(search.find(Serial{}, std::span<const PointSource>(&source, 1), options),
                  UsageError);
  CHECK_THROWS_AS(search.find(Serial{}, PointSource::at(77), 1), UsageError);
  CHECK(search.bytes() > 0);
}

TEST_CASE("a search that finds a distance finds a path on needles too") {
  const auto file = exact_file("surfaces", "t79741.obj");
  if (file.empty()) {
    WARN("skipped: no t79741");
    return;
  }
  const auto surface = io::read_triangles(file);
  const TriangleMesh<float> mesh(surface.positions, surface.triangles);
  PathSearch<float> search(mesh, surface.positions);
  // Its labels lead back in a circle.
  const SearchResult found = search.find(Serial{}, PointSource::at(2013), PointSource::at(3995));
  REQUIRE(found.paths.size() == 1);
  CHECK(found.paths[0].length == Approx(16.7304).epsilon(1e-4));
  CHECK(found.paths[0].source == 0);
}

namespace {

constexpr Index sides = 12, rings = 8;
constexpr double height = 2;

// A tube of flat sides, which unrolls into the plane.
struct Tube {
  std::vector<std::array<double, 3>> positions;
  std::vector<std::array<Index, 3>> faces;

  Tube() {
    for (Index k = 0; k <= rings; ++k)
      for (Index i = 0; i < sides; ++i) {
        const double angle = 2 * std::numbers::pi * i / sides;
        positions.push_back({std::cos(angle), std::sin(angle), height * k / rings});
      }
    for (Index k = 0; k < rings; ++k)
      for (Index i = 0; i < sides; ++i) {
        const Index a = k * sides + i, b = k * sides + (i + 1) % sides;
        faces.push_back({a, b, a + sides});
        faces.push_back({b, b + sides, a + sides});
      }
  }
};
const double around = 2 * sides * std::sin(std::numbers::pi / sides);

// `turns` times around along edges, then straight up.
std::vector<PathPoint> staircase(int turns) {
  std::vector<PathPoint> path;
  for (int t = 0; t < turns; ++t)
    for (Index i = 0; i < sides; ++i) path.push_back({2 * i, {1, 0, 0, 0}});
  for (Index k = 0; k < rings; ++k) path.push_back({2 * k * sides, {1, 0, 0, 0}});
  path.push_back({2 * (rings - 1) * sides, {0, 0, 1, 0}});
  return path;
}

}  // namespace

TEMPLATE_TEST_CASE("a path that is pulled tight keeps its turns", "", float, double) {
  const Tube tube;
  const TriangleMesh<TestType> mesh(tube.positions, tube.faces);
  for (const int turns : {0, 1, 2, 5}) {
    const Path path = shortened(mesh, staircase(turns), tube.positions);
    CHECK(path.length == Approx(std::hypot(turns * around, height)).epsilon(1e-12));
    CHECK(path.positions.front() == tube.positions[0]);
    CHECK(path.positions.back() == tube.positions[rings * sides]);
    // And once more it is what it was.
    CHECK(shortened(mesh, path.points, tube.positions).length == Approx(path.length));
  }
  const Path unplaced = shortened(mesh, staircase(1));
  CHECK(unplaced.length == Approx(std::hypot(around, height)).epsilon(1e-6));
  CHECK(unplaced.positions.empty());
}

TEST_CASE("what is no path is not pulled") {
  const Tube tube;
  const TriangleMesh<double> mesh(tube.positions, tube.faces);
  CHECK_THROWS_AS(shortened(mesh, std::vector<PathPoint>{}), UsageError);
  const std::vector<PathPoint> outside = {{7777, {1, 0, 0, 0}}};
  CHECK_THROWS_AS(shortened(mesh, outside), UsageError);
  const std::vector<PathPoint> apart = {{0, {1, 0, 0, 0}}, {100, {1, 0, 0, 0}}};
  CHECK_THROWS_WITH(shortened(mesh, apart), "points 0 and 1 of the path are in no common triangle");
  const std::vector<PathPoint> still = {{0, {.5, .5, 0, 0}}};
  CHECK(shortened(mesh, still, tube.positions).length == 0);
}

}  // namespace plexway::testing::search_test
