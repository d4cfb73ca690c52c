// Paths whose ends lie where rounding could decide: on edges, and at sources.

#include <numbers>

#include "paths/path_testing.hpp"
#include "with_accuracy.hpp"

namespace plexway::testing::edge_path_test {

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

}  // namespace plexway::testing::edge_path_test
