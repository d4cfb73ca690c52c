#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <cstddef>
#include <string>

#include <plexway/error.hpp>
#include <plexway/solve.hpp>

#include "data/long_strips.hpp"
#include "data/shapes.hpp"
#include "windows/windows_solving.hpp"

namespace plexway::testing::windows_limits_test {

TEMPLATE_TEST_CASE("windows: radius, labels, offsets, budget, progress", "", float, double) {
  const Surface s = grid(20, 20);
  const auto mesh = s.mesh<TestType>();
  Workspace<TestType> workspace;
  DistanceField<TestType> field, other;
  const PointSource corner = PointSource::at(0);
  const auto from_corner = straight(s, s.positions[0]);
  for (const Accuracy accuracy : window_accuracies) {
    CAPTURE(name(accuracy));
    const double off = accuracy == Accuracy::exact() ? 1e-6 : 1e-3;
    PropagateOptions options;
    options.radius = .5;
    solve_windows(mesh, {&corner, 1}, accuracy, options, workspace, field);
    CHECK(field.label.empty());
    CHECK(field.complete);
    bool right = true;
    for (std::size_t v = 0; v < from_corner.size(); ++v)
      right &= from_corner[v] > .5 + off ? std::isinf(field.distance[v])
                                         : from_corner[v] > .5 - off ||
                                               std::abs(field.distance[v] - from_corner[v]) < off;
    CHECK(right);

    PointSource far = PointSource::at(s.nearest(1, 1));
    far.offset = .1234567;
    const auto from_far = straight(s, {1, 1, 0});
    const std::vector<PointSource> both = {corner, far};
    solve_windows(mesh, both, accuracy, {}, workspace, field);
    right = field.label.size() == from_far.size();
    for (std::size_t v = 0; v < from_far.size() && right; ++v) {
      const double a = from_corner[v], b = from_far[v] + far.offset;
      right &= std::abs(static_cast<double>(field.distance[v]) - std::min(a, b)) < off;
      right &= std::abs(a - b) < off || field.label[v] == (a < b ? 0u : 1u);
    }
    CHECK(right);
    CHECK(field.distance[far.vertex] == static_cast<TestType>(.1234567));
    solve_windows(mesh, both, accuracy, {}, workspace, other);
    CHECK(other.distance == field.distance);

    options = {};
    options.max_expansions = 40;
    solve_windows(mesh, {&corner, 1}, accuracy, options, workspace, field);
    CHECK_FALSE(field.complete);
    CHECK(field.statistics.expansions == 40);
    CHECK(field.distance[0] == 0);
    CHECK(std::isinf(field.distance.back()));
  }
}

TEMPLATE_TEST_CASE("windows: a callback sees them go and may stop them", "", float, double) {
  const Surface s = grid(160, 160);
  const auto mesh = s.mesh<TestType>();
  Workspace<TestType> workspace;
  DistanceField<TestType> field;
  const PointSource corner = PointSource::at(0);
  for (const Accuracy accuracy : window_accuracies) {
    PropagateOptions options;
    int calls = 0;
    double before = 0;
    bool forward = true;
    options.progress = [&](const Progress& p) {
      forward &= p.distance >= before && p.distance < 2;
      before = p.distance;
      return ++calls < 100;
    };
    solve_windows(mesh, {&corner, 1}, accuracy, options, workspace, field);
    CHECK(calls > 0);
    CHECK(forward);
    options.progress = [](const Progress&) { return false; };
    CHECK_THROWS_AS(solve_windows(mesh, {&corner, 1}, accuracy, options, workspace, field),
                    Cancelled);
    solve_windows(mesh, {&corner, 1}, accuracy, {}, workspace, field);
    CHECK(field.distance.back() == Approx(std::sqrt(2.)).epsilon(1e-3));
  }
}

TEMPLATE_TEST_CASE("merged windows hold few bytes a vertex", "[windows]", float, double) {
  const auto shape = samples::bumpy(50);
  const TriangleMesh<TestType> mesh(shape.points, shape.faces);
  Workspace<TestType> workspace;
  DistanceField<TestType> field;
  PropagateOptions options;
  options.accuracy = Accuracy::accurate();
  std::size_t first = 0;
  for (const Index source : {Index{0}, Index{7}, Index{20000}}) {
    solve(Serial{}, mesh, PointSource::at(source), options, workspace, field);
    if (first == 0) first = workspace.bytes();
  }
  const double bytes =
      static_cast<double>(workspace.bytes()) / static_cast<double>(mesh.vertex_count());
  CAPTURE(bytes);
  CHECK(bytes < (sizeof(TestType) == 4 ? 36 : 48));
  CHECK(2 * workspace.bytes() < 3 * first);
}

namespace {

struct Off {
  double mean = 0, worst = 0;
};

/// How far off distances in a flat strip are that is so many edges long.
template <class Real>
Off off_in(const TriangleMesh<Real>& mesh, const samples::LongStrip& strip) {
  const auto distance = solve_windows(mesh, {PointSource::at(0)}, Accuracy::accurate());
  Off off;
  for (Index v = 1; v < strip.vertices(); ++v) {
    const double e = std::abs(distance[v] / strip.between(0, v) - 1);
    off.mean += e / (strip.vertices() - 1);
    off.worst = std::max(off.worst, e);
  }
  return off;
}

}  // namespace

TEMPLATE_TEST_CASE("merged windows: strips very many edges long", "", float, double) {
  for (const Index edges : {Index{10000}, Index{100000}}) {
    const samples::LongStrip strip(edges, 2, 1);
    const auto check = [&, edges](const TriangleMesh<TestType>& mesh, const std::string& form) {
      const Off off = off_in(mesh, strip);
      CAPTURE(edges, form, off.mean, off.worst);
      CHECK(off.mean <= (edges == 10000 ? 1e-4 : 3e-5));
      CHECK(off.worst <= 2e-4);
    };
    check({strip.vertices(), strip.faces, strip.lengths()}, "by lengths alone");
    check({strip.wound(), strip.faces}, "wound up");
    const Off flat = off_in(TriangleMesh<TestType>(strip.in_plane(), strip.faces), strip);
    CHECK(flat.mean <= 1e-7);
  }
}

}  // namespace plexway::testing::windows_limits_test
