#include <catch2/catch.hpp>
#include <numbers>

#include <plexway/error.hpp>
#include <plexway/io/triangles.hpp>
#include <plexway/pairs/distance_matrix.hpp>

#include "exact_data.hpp"
#include "paths/path_testing.hpp"
#include "with_accuracy.hpp"

namespace plexway::testing::window_paths_test {

// Paths, distances inside triangles and directions after a solve by windows.

namespace {

Surface landscape(Index n, unsigned seed) {
  std::mt19937 random(seed);
  Surface s = grid(n, n);
  for (Position& p : s.positions) p[2] = .8 / n * uniform(random);
  return s;
}

/// Paths to vertices and to points inside triangles are as long as distances are.
template <class Real>
void check_agreement(const Surface& s, const std::vector<PointSource>& sources, Accuracy accuracy,
                     double within, int count, unsigned seed) {
  const TriangleMesh<Real> mesh(s.positions, s.faces);
  PathField field(mesh, s.positions);
  field.solve(Serial{}, std::span<const PointSource>(sources), at(accuracy));
  std::mt19937 random(seed);
  double worst = 0, mean = 0;
  for (int k = 0; k < count; ++k) {
    const PointSource target =
        k % 2 ? PointSource::at(below(random, s.positions.size())) : anywhere(s.faces, random);
    const Path path = field.trace(target);
    check_path(path, s.positions, s.faces);
    REQUIRE(path.source < sources.size());
    const double length = path.length + sources[path.source].offset, d = field.at(target);
    const double off = std::abs(d - length) / length;
    worst = std::max(worst, off);
    mean += off / count;
  }
  CAPTURE(worst, mean, accuracy.error());
  CHECK(worst <= within);
}

}  // namespace

TEST_CASE("after windows a source on an edge is seen from all triangles there") {
  Surface s = grid(12, 12);
  std::mt19937 random(3);
  for (Position& p : s.positions)
    for (std::size_t i = 0; i < 2; ++i)
      if (p[0] > 0 && p[0] < 1 && p[1] > 0 && p[1] < 1) p[i] += (uniform(random) - .5) / 24;
  const auto mesh = s.mesh<double>();
  const auto place = [&](Index f, const std::array<double, 3>& weight) {
    Position p = {0, 0, 0};
    for (std::size_t i = 0; i < 3; ++i)
      for (std::size_t k = 0; k < 3; ++k) p[k] += weight[i] * s.positions[s.faces[f][i]][k];
    return p;
  };
  for (const Index f : {40u, 271u})
    for (std::size_t e = 0; e < 3; ++e) {
      std::array<double, 3> on_edge = {0, 0, 0};
      on_edge[e] = .3;
      on_edge[(e + 1) % 3] = .7;
      const Position source = place(f, on_edge);
      PathField field(mesh, s.positions);
      field.solve(Serial{}, PointSource::in(f, on_edge));
      for (Index g = 0; g < s.faces.size(); ++g) {
        const Position p = place(g, {.2, .3, .5});
        CHECK(field.at(PointSource::in(g, {.2, .3, .5})) ==
              Approx(std::hypot(p[0] - source[0], p[1] - source[1])).epsilon(1e-4));
      }
    }
}

TEST_CASE("after windows paths are as long as distances") {
  for (unsigned seed = 1; seed <= 3; ++seed) {
    const Surface s = landscape(24, seed);
    std::vector<PointSource> sources = {PointSource::at(17 * seed)};
    check_agreement<double>(s, sources, Accuracy::exact(), 1e-6, 60, seed);
    check_agreement<float>(s, sources, Accuracy::accurate(), 3e-3, 60, seed);
    sources.push_back(PointSource::in(500, {.3, .1, .6}));
    sources.back().offset = .11;
    check_agreement<double>(s, sources, Accuracy::exact(), 1e-6, 60, seed);
    check_agreement<float>(s, sources, Accuracy::accurate(), 3e-3, 60, seed);
  }
}

TEST_CASE("after windows paths are as long as distances: scans") {
  for (const char* const what : {"spot", "fandisk", "rocker-arm"}) {
    const auto file = exact_file("surfaces", std::string(what) + ".obj");
    if (file.empty()) continue;
    io::Triangles t = io::read_triangles(file);
    const Surface s{std::move(t.positions), std::move(t.triangles)};
    CAPTURE(what);
    check_agreement<double>(s, {PointSource::at(99)}, Accuracy::exact(), 1e-6, 30, 5);
    check_agreement<float>(s, {PointSource::at(99)}, Accuracy::accurate(), 5e-3, 30, 5);
  }
}

TEMPLATE_TEST_CASE("distances inside triangles and directions by windows, in the plane", "", float,
                   double) {
  const Surface s = random_polygon(9, 150, 200, 4);
  const auto mesh = s.mesh<TestType>();
  const PointSource source = PointSource::in(31, {.25, .35, .4});
  const Position from = place(s.positions, s.faces[31], source.barycentric);
  for (const Accuracy accuracy : {Accuracy::accurate(), Accuracy::exact()}) {
    if (std::is_same_v<TestType, float> && accuracy == Accuracy::exact()) continue;
    PathField field(mesh, s.positions);
    field.solve(Serial{}, source, at(accuracy));
    const double within = accuracy == Accuracy::exact() ? 1e-9 : 1e-4;
    std::mt19937 random(2);
    for (int k = 0; k < 200; ++k) {
      const PointSource p = anywhere(s.faces, random);
      const double exact = apart(from, place(s.positions, s.faces[p.simplex], p.barycentric));
      CHECK(field.at(p) == Approx(exact).epsilon(within).margin(1e-7));
    }
    const auto direction = field.gradient();
    for (std::size_t f = 0; f < s.faces.size(); ++f) {
      const double third = 1. / 3;
      const Position centre = place(s.positions, s.faces[f], {third, third, third, 0});
      const double far = apart(from, centre);
      if (far < 1e-3) continue;
      double along = 0;
      for (std::size_t k = 0; k < 3; ++k) along += direction[f][k] * (centre[k] - from[k]) / far;
      CHECK(along >= 1 - (accuracy == Accuracy::exact() ? 1e-9 : 1e-3));
    }
  }
}

TEST_CASE("labels of triangles by windows are those of the nearest source") {
  const Surface s = grid(20, 20);
  const auto mesh = s.mesh<double>();
  const std::vector<PointSource> sources = {PointSource::at(44), PointSource::at(300)};
  PathField field(mesh, s.positions);
  field.solve(Serial{}, std::span<const PointSource>(sources), at(Accuracy::exact()));
  const std::vector<Index> labels = field.simplex_labels();
  REQUIRE(labels.size() == s.faces.size());
  for (std::size_t f = 0; f < s.faces.size(); ++f) {
    const double third = 1. / 3;
    const Position centre = place(s.positions, s.faces[f], {third, third, third, 0});
    const double one = apart(centre, s.positions[44]), other = apart(centre, s.positions[300]);
    if (std::abs(one - other) > 1e-9) CHECK(labels[f] == (one < other ? 0u : 1u));
  }
}

TEST_CASE("what a radius leaves out is infinitely far inside triangles too") {
  const Surface s = grid(20, 20);
  const auto mesh = s.mesh<double>();
  PropagateOptions options = at(Accuracy::exact());
  options.radius = .3;
  PathField field(mesh, s.positions);
  field.solve(Serial{}, PointSource::at(0), options);
  CHECK(
      std::isinf(field.at(PointSource::in(static_cast<Index>(s.faces.size() - 1), {.2, .3, .5}))));
  CHECK(field.at(PointSource::in(0, {.2, .3, .5})) < .1);
}

TEST_CASE("a matrix of distances by windows") {
  const Surface s = random_polygon(8, 120, 100, 6);
  std::mt19937 random(3);
  std::vector<PointSource> points;
  std::vector<Position> places;
  for (int k = 0; k < 8; ++k) {
    points.push_back(k % 2 ? PointSource::at(below(random, s.positions.size()))
                           : anywhere(s.faces, random));
    const PointSource& p = points.back();
    places.push_back(p.vertex != none ? s.positions[p.vertex]
                                      : place(s.positions, s.faces[p.simplex], p.barycentric));
  }
  const auto exact = distance_matrix(Serial{}, s.mesh<double>(), points, {}, Accuracy::exact());
  const auto near = distance_matrix(Serial{}, s.mesh<float>(), points, {}, Accuracy::accurate());
  CHECK(exact.accuracy == Accuracy::exact());
  CHECK(exact.asymmetry < 1e-9);
  for (std::size_t i = 0; i < points.size(); ++i)
    for (std::size_t j = 0; j < points.size(); ++j) {
      const double d = apart(places[i], places[j]);
      CHECK(exact(i, j) == Approx(d).epsilon(1e-9).margin(1e-12));
      CHECK(near(i, j) == Approx(d).epsilon(1e-4).margin(1e-6));
    }
  CHECK_THROWS_AS(distance_matrix(Serial{}, s.mesh<float>(), points, {}, Accuracy::exact()),
                  UsageError);
}

// Paths whose ends lie where rounding could decide: on edges, and at sources.

namespace {

// A plane in space, its inner vertices moved, so that points on edges are on them only by rounding.
Surface tilted(std::mt19937& random, Index n) {
  Surface s = grid(n, n, n, n);
  const double turn = uniform(random), tilt = 0.8 * uniform(random);
  for (Position& p : s.positions) {
    double x = p[0], y = p[1];
    if (p[0] > 0 && p[0] < n) x += 0.4 * (uniform(random) - 0.5);
    if (p[1] > 0 && p[1] < n) y += 0.4 * (uniform(random) - 0.5);
    p = {x * std::cos(turn) - y * std::sin(turn) * std::cos(tilt),
         x * std::sin(turn) + y * std::cos(turn) * std::cos(tilt), y * std::sin(tilt)};
  }
  return s;
}

PointSource on_edge(const Surface& s, std::mt19937& random) {
  std::array<double, 3> b = {0, 0, 0};
  const std::size_t i = below(random, 3);
  b[i] = uniform(random);
  b[(i + 1) % 3] = 1 - b[i];
  return PointSource::in(below(random, s.faces.size()), b);
}

Position position(const Surface& s, const PointSource& p) {
  return place(s.positions, s.faces[p.simplex], p.barycentric);
}

}  // namespace

TEMPLATE_TEST_CASE("paths from and to points on edges are straight in a plane", "", float, double) {
  const double rounding = sizeof(TestType) == 4 ? 1e-6 : 1e-11;
  double worst = 0, worst_promise = 0;
  for (unsigned seed = 1; seed <= 25; ++seed) {
    std::mt19937 random(seed);
    const Surface s = tilted(random, 4);
    const auto mesh = s.mesh<TestType>();
    PathField field(mesh, s.positions);
    for (int k = 0; k < 8; ++k) {
      const PointSource source = k % 2 == 0 ? anywhere(s.faces, random) : on_edge(s, random);
      field.solve(Serial{}, source);
      for (int n = 0; n < 20; ++n) {
        const PointSource target =
            k % 2 == 1 && n % 2 == 1 ? anywhere(s.faces, random) : on_edge(s, random);
        const Position from = position(s, target), to = position(s, source);
        const Path path = field.trace(target);
        if (n == 0) check_path(path, s.positions, s.faces);
        REQUIRE_FALSE(path.positions.empty());
        CHECK(apart(path.positions.front(), from) < 1e-12);
        CHECK(apart(path.positions.back(), to) < 1e-12);
        const double exact = apart(from, to);
        worst = std::max(worst, path.length - exact);
        worst_promise = std::max(worst_promise, exact - path.length);
      }
    }
  }
  CHECK(worst < rounding);
  CHECK(worst_promise < rounding);
}

TEST_CASE("a path from a source with an offset may stay there") {
  // Offsets just below what other ways there take: then the shortest way has no length.
  Surface s = grid(20, 20);
  for (Position& p : s.positions) p[2] = 0.2 * std::sin(9 * p[0]) * std::cos(7 * p[1]);
  const auto mesh = s.mesh<double>();
  PathField field(mesh, s.positions);
  const TraceOptions none_wider{.margin = 0};
  std::size_t stayed = 0;
  for (const Index from : {0u, 10u, 220u})
    for (Index to = 0; to < mesh.vertex_count(); ++to) {
      field.solve(Serial{}, PointSource::at(from), by_labels());
      const double field_says = field.distances().distance[to];
      const double traced = field.trace(to, none_wider).length;
      if (!(traced > field_says * (1 + 1e-5))) continue;
      for (const double share : {0.5, 0.9, 0.999}) {
        std::vector<PointSource> sources = {PointSource::at(from), PointSource::at(to)};
        sources[1].offset = share * traced + (1 - share) * field_says;
        field.solve(Serial{}, sources, by_labels());
        const Path path = field.trace(to);
        REQUIRE(path.source < 2);
        CHECK(path.length + sources[path.source].offset <= sources[1].offset * (1 + 1e-9));
        if (path.source != 1) continue;
        CHECK(path.length == 0);
        REQUIRE(path.positions.size() == 1);
        CHECK(apart(path.positions[0], s.positions[to]) < 1e-15);
        ++stayed;
      }
    }
  CHECK(stayed > 0);
}

TEST_CASE("paths through sharp tips that touch are straight on both sides") {
  // Two pyramids whose tips meet: closed fans, less than a full turn in all.
  Surface s;
  const Index n = 5, tip = s.add(0, 0, 0);
  const double height = 2, radius = 0.3;
  for (const double up : {1., -1.})
    for (Index i = 0; i < n; ++i) {
      const double a = 2 * std::numbers::pi * i / n;
      s.add(radius * std::cos(a), radius * std::sin(a), up * height);
    }
  for (Index k = 0; k < 2; ++k)
    for (Index i = 0; i < n; ++i) s.triangle(tip, 1 + k * n + i, 1 + k * n + (i + 1) % n);
  const auto mesh = s.mesh<double>();
  REQUIRE(mesh.summary().pinched_vertices == 1);
  PathField field(mesh, s.positions);
  std::mt19937 random(2);
  for (int k = 0; k < 20; ++k) {
    PointSource source = anywhere(s.faces, random), target = anywhere(s.faces, random);
    source.simplex %= n, target.simplex = target.simplex % n + n;
    // And another on the target's own side, which is farther by its offset but not by much.
    PointSource other = anywhere(s.faces, random);
    other.simplex = other.simplex % n + n;
    const double whole =
        apart(position(s, source), s.positions[tip]) + apart(position(s, target), s.positions[tip]);
    other.offset = whole * 1.0001;
    field.solve(Serial{}, std::vector<PointSource>{source, other});
    const Path path = field.trace(target);
    CHECK(path.source == 0);
    CHECK(path.length == Approx(whole).epsilon(1e-12));
  }
}

}  // namespace plexway::testing::window_paths_test
