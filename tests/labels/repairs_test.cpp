#include <catch2/catch.hpp>
#include <cmath>
#include <random>
#include <string>

#include <plexway/solve.hpp>
#include <plexway/surface/intrinsic_delaunay.hpp>

#include "labels/solving.hpp"
#include "with_accuracy.hpp"

namespace plexway::testing::repairs_test {

// What is cheap to see of a field, and always wrong: a distance below the straight line through
// space, and a vertex farther than a neighbour and the edge between.
namespace {

/// A height field of jittered points with one of them far up.
Surface spike(double height, unsigned seed) {
  std::mt19937 random(seed);
  Surface s = grid(8, 8, 8, 8);
  for (Position& p : s.positions)
    for (std::size_t k = 0; k < 3; ++k) p[k] += 0.35 * (2 * uniform(random) - 1);
  s.positions[30][2] = height;
  return s;
}

/// Thin triangles about vertex 0, by chance near and far.
Surface fan(Index count, unsigned seed) {
  std::mt19937 random(seed);
  Surface s;
  s.positions.push_back({0, 0, 0});
  for (Index i = 0; i < count; ++i) {
    const double a = 2 * 3.14159265358979 * i / count, r = 1 + 3 * uniform(random);
    s.positions.push_back({r * std::cos(a), r * std::sin(a), 0.5 * uniform(random)});
    s.faces.push_back({0, i + 1, (i + 1) % count + 1});
  }
  return s;
}

double apart(const Position& a, const Position& b) {
  return std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]);
}

void check_field(const Surface& s, const std::vector<double>& d, const std::vector<Index>& sources,
                 double slack) {
  double below = 0, beyond = 0;
  for (std::size_t v = 0; v < s.positions.size(); ++v) {
    double line = std::numeric_limits<double>::infinity();
    for (const Index source : sources)
      line = std::min(line, apart(s.positions[v], s.positions[source]));
    if (std::isfinite(d[v]) && line > 0) below = std::min(below, d[v] / line - 1);
  }
  for (const auto& f : s.faces)
    for (std::size_t i = 0; i < 3; ++i) {
      const Index v = f[i], w = f[(i + 1) % 3];
      const double gap = std::abs(d[v] - d[w]) - apart(s.positions[v], s.positions[w]);
      beyond = std::max(beyond, gap / std::max(d[v], d[w]));
    }
  CHECK(below >= -slack);
  CHECK(beyond <= slack);
}

/// On all triangulations and both executors.
template <class Real>
void check_surface(const Surface& s, const std::vector<Index>& from) {
  const double slack = sizeof(Real) == 4 ? 1e-6 : 1e-12;
  const TriangleMesh<double> exact(s.positions, s.faces);
  for (const auto kind :
       {Retriangulation::keep, Retriangulation::flips, Retriangulation::refined}) {
    const auto mesh = [&]() -> TriangleMesh<Real> {
      if (kind == Retriangulation::keep) return {s.positions, s.faces};
      return IntrinsicDelaunay(exact, refinement_for(kind)).mesh<Real>();
    }();
    std::vector<PointSource> sources;
    for (const Index v : from) sources.push_back(PointSource::at(v));
    const std::span<const PointSource> all(sources);
    CAPTURE(static_cast<int>(kind), from[0]);
    const auto check = [&](const DistanceField<Real>& field) {
      check_field(s, {field.distance.begin(), field.distance.end()}, from, slack);
    };
    check(plexway::solve(Serial{}, mesh, all));
    check(plexway::solve(Serial{}, mesh, all, by_labels()));
    check(plexway::solve(OpenMP{2}, mesh, all, by_labels()));
  }
}

}  // namespace

TEMPLATE_TEST_CASE("no distance is below the straight line around a spike", "", float, double) {
  std::size_t raised = 0;
  for (const double height : {30., 1000., 1e4})
    for (unsigned seed = 0; seed < 4; ++seed) {
      const Surface s = spike(height, seed);
      CAPTURE(height, seed);
      for (const Index source : {0u, 33u, 63u, 80u}) {
        check_surface<TestType>(s, {source});
        const auto flipped = IntrinsicDelaunay(s.mesh<double>()).mesh<TestType>();
        raised += plexway::solve(Serial{}, flipped, PointSource::at(source), by_labels())
                      .statistics.raised_vertices;
      }
      check_surface<TestType>(s, {7, 33, 78});
    }
  // Else there was nothing to see here.
  CHECK(raised > 0);
}

TEMPLATE_TEST_CASE("in fans of thin triangles no vertex is farther than a neighbour and an edge",
                   "", float, double) {
  std::size_t lowered = 0;
  for (unsigned seed = 0; seed < 4; ++seed) {
    const Surface s = fan(150, seed);
    CAPTURE(seed);
    check_surface<TestType>(s, {1});
    check_surface<TestType>(s, {0, 75});
    const auto flipped = IntrinsicDelaunay(s.mesh<double>()).mesh<TestType>();
    CHECK(flipped.has_chords());
    lowered += plexway::solve(Serial{}, flipped, PointSource::at(1), by_labels())
                   .statistics.lowered_vertices;
  }
  CHECK(lowered > 0);
}

TEST_CASE("among triangles thrown together by chance no distance is below the straight line") {
  for (unsigned seed = 0; seed < 3; ++seed) {
    const Surface s = soup(60, 4000, seed);
    CAPTURE(seed);
    check_surface<float>(s, {1});
    check_surface<double>(s, {1, 2, 3});
  }
}

TEST_CASE("a source in a triangle is bounded by the straight line as well") {
  const Surface s = spike(1000, 2);
  for (const Index f : {0u, 40u, 70u, 120u}) {
    const PointSource source = PointSource::in(f, {0.2, 0.3, 0.5});
    Position at = {0, 0, 0};
    for (std::size_t i = 0; i < 3; ++i)
      for (std::size_t k = 0; k < 3; ++k)
        at[k] += source.barycentric[i] * s.positions[s.faces[f][i]][k];
    const auto d = solve(s.mesh<float>(), source);
    for (std::size_t v = 0; v < d.size(); ++v)
      CHECK(d[v] >= apart(at, s.positions[v]) * (1 - 1e-6));
  }
}

TEST_CASE("lengths alone know no straight line, and good fields need no repair") {
  const Surface s = spike(100, 1);
  const TriangleMesh<float> mesh(s.positions.size(), s.faces, lengths_of(s));
  CHECK(mesh.positions().empty());
  CHECK(plexway::solve(Serial{}, mesh, PointSource::at(0)).statistics.raised_vertices == 0);
  const Surface flat = grid(30, 30);
  const auto field = plexway::solve(Serial{}, flat.mesh<float>(), PointSource::at(7));
  CHECK(field.statistics.raised_vertices == 0);
  CHECK(field.statistics.lowered_vertices == 0);
}

}  // namespace plexway::testing::repairs_test
