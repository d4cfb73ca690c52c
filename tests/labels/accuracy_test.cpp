#include <catch2/catch.hpp>

#include <memory>

#include <plexway/error.hpp>
#include <plexway/io/triangles.hpp>
#include <plexway/surface/intrinsic_delaunay.hpp>

#include "exact_data.hpp"
#include "labels/solving.hpp"
#include "with_accuracy.hpp"

namespace plexway::testing::accuracy_test {

// PropagateOptions::accuracy, as solve takes it: what the windows_*_test measure of the engine is
// not measured again.
namespace {

/// A landscape with saddles everywhere.
Surface hills(Index n, unsigned seed) {
  std::mt19937 random(seed);
  Surface s = grid(n, n);
  for (Position& p : s.positions) p[2] = .6 / n * uniform(random) + .1 * std::sin(9 * p[0] * p[1]);
  return s;
}

}  // namespace

TEST_CASE("each accuracy keeps what it promises on a landscape with saddles") {
  const Surface s = hills(60, 3);
  const auto mesh = s.mesh<double>();
  const auto single = s.mesh<float>();
  double fast = 0, accurate = 0, coarse = 0;
  for (const Index source : {0u, 1800u, 3700u}) {
    const auto exact = solve(mesh, PointSource::at(source), at(Accuracy::exact()));
    const auto mean = [&](Accuracy accuracy) {
      return compare(solve(single, PointSource::at(source), at(accuracy)), exact).mean / 3;
    };
    fast += mean(Accuracy::fast());
    accurate += mean(Accuracy::accurate());
    coarse += mean(Accuracy(5e-4));
  }
  CAPTURE(fast, accurate, coarse);
  CHECK(accurate < 2e-4);
  CHECK(coarse < 1e-3);
  CHECK(accurate < coarse);
  CHECK(5 * accurate < fast);
}

TEST_CASE("a workspace knows another surface in the same place") {
  Workspace<double> workspace;
  DistanceField<double> field;
  const auto fits = [&](const TriangleMesh<double>& mesh, Index source) {
    solve(Serial{}, mesh, PointSource::at(source), at(Accuracy::exact()), workspace, field);
    CHECK(field.distance ==
          solve(Serial{}, mesh, PointSource::at(source), at(Accuracy::exact())).distance);
  };
  const Surface one = hills(12, 1), other = hills(12, 2);
  auto mesh = std::make_unique<TriangleMesh<double>>(one.mesh<double>());
  fits(*mesh, 5);
  const TriangleMesh<double> copy = *mesh;
  *mesh = other.mesh<double>();  // same address and size
  fits(*mesh, 5);
  fits(copy, 5);
  *mesh = copy;  // same address, another's content
  fits(*mesh, 7);
  TriangleMesh<double> moved = std::move(*mesh);
  mesh.reset();
  fits(moved, 9);
  Workspace<double> taken = std::move(workspace);
  solve(Serial{}, moved, PointSource::at(3), at(Accuracy::exact()), taken, field);
  CHECK(field.distance[3] == 0);
}

TEST_CASE("a field tells its accuracy, and errors where windows were merged") {
  const Surface s = hills(16, 5);
  const auto mesh = s.mesh<float>();
  Workspace<float> workspace;
  DistanceField<float> field;
  solve(Serial{}, mesh, PointSource::at(0), at(Accuracy::accurate()), workspace, field);
  CHECK(field.accuracy == Accuracy::accurate());
  REQUIRE(field.error.size() == s.positions.size());
  CHECK(*std::max_element(field.error.begin(), field.error.end()) > 0);
  // Nothing of it stays behind.
  solve(Serial{}, mesh, PointSource::at(0), at(Accuracy::fast()), workspace, field);
  CHECK(field.accuracy == Accuracy::fast());
  CHECK(field.error.empty());
  // Balls have those of their centres.
  const BallSource ball{.centre = PointSource::at(40), .radius = .1};
  solve(Serial{}, mesh, ball, at(Accuracy::accurate()), workspace, field);
  CHECK(field.accuracy == Accuracy::accurate());
  REQUIRE(field.error.size() == s.positions.size());
  CHECK(*std::max_element(field.error.begin(), field.error.end()) > 0);
  for (const double no : {-1., 1., std::nan("")})
    CHECK_THROWS_AS(solve(Serial{}, mesh, PointSource::at(0), at(Accuracy(no))), UsageError);
}

TEST_CASE("several threads take one source each with the bits of one thread", "[threads]") {
  if (!openmp_built()) return;
  const Surface s = hills(20, 6);
  const auto mesh = s.mesh<float>();
  const std::vector<PointSource> sources = {PointSource::at(3), PointSource::at(200),
                                            PointSource::in(77, {.2, .5, .3})};
  const auto team = solve_each(OpenMP{.threads = 2}, mesh, sources, at(Accuracy::accurate()));
  const auto alone = solve_each(Serial{}, mesh, sources, at(Accuracy::accurate()));
  CHECK(std::equal(team.values().begin(), team.values().end(), alone.values().begin()));
  const auto one = solve(OpenMP{2}, mesh, sources[0], at(Accuracy::accurate()));
  CHECK(std::equal(one.distance.begin(), one.distance.end(), alone.row(0).begin()));
}

TEMPLATE_TEST_CASE("on a line distances are along it, whatever the accuracy", "", float, double) {
  std::mt19937 random(8);
  for (const bool jitter : {false, true}) {
    Surface s = grid(8, 3);
    for (Position& p : s.positions) p = {p[0] + jitter * .1 * uniform(random), 0, 0};
    std::vector<Accuracy> all = {Accuracy::fast(), Accuracy::accurate(), Accuracy(1e-2)};
    if (std::is_same_v<TestType, double>) all.push_back(Accuracy::exact());
    for (const Accuracy accuracy : all)
      for (const Index source : {0u, 13u}) {
        CAPTURE(jitter, accuracy.error(), source);
        const auto d = solve(s.mesh<TestType>(), PointSource::at(source), at(accuracy));
        const auto line = straight(s, s.positions[source]), edges = along_edges(s, source);
        bool between = true;  // a way over a fold may be shorter than all along edges
        for (std::size_t v = 0; v < d.size(); ++v)
          between &= d[v] >= line[v] - 1e-5 && d[v] <= edges[v] + 1e-5;
        CHECK(between);
        if (jitter) continue;
        const Errors e = compare(d, line);
        CHECK(e.fits);
        CHECK(e.max < 1e-5);
      }
  }
}

// Raising to the straight line belongs to `fast`: windows do not need it.
TEST_CASE("windows are nowhere below the straight line, nor beyond a neighbour's edge") {
  for (const char* const what : {"spot", "fandisk", "beetle_car", "rocker-arm", "t908460"}) {
    const auto file = exact_file("surfaces", std::string(what) + ".obj");
    if (file.empty()) continue;
    const io::Triangles t = io::read_triangles(file);
    const TriangleMesh<double> mesh(t.positions, t.triangles);
    // Merging is not for needles: on those triangles that the tool takes as well.
    const auto single =
        what[0] == 't'
            ? IntrinsicDelaunay(mesh, refinement_for(Retriangulation::refined)).mesh<float>()
            : TriangleMesh<float>(t.positions, t.triangles);
    Workspace<float> workspace;
    Workspace<double> exact_workspace;
    DistanceField<float> field;
    DistanceField<double> exact;
    std::mt19937 random(11);
    const auto check = [&](const auto& distance, Index source, double slack) {
      double below = 0, beyond = 0;
      const auto apart = [&](Index v, Index w) {
        const auto &p = t.positions[v], &q = t.positions[w];
        return std::hypot(p[0] - q[0], p[1] - q[1], p[2] - q[2]);
      };
      const auto d = [&](Index v) { return static_cast<double>(distance[v]); };
      for (Index v = 0; v < t.positions.size(); ++v)
        if (v != source) below = std::min(below, d(v) / apart(v, source) - 1);
      for (const auto& f : t.triangles)
        for (std::size_t i = 0; i < 3; ++i) {
          const Index v = f[i], w = f[(i + 1) % 3];
          beyond = std::max(beyond, (std::abs(d(v) - d(w)) - apart(v, w)) / std::max(d(v), d(w)));
        }
      CAPTURE(what, source, below, beyond);
      CHECK(below >= -slack);
      CHECK(beyond <= slack);
    };
    for (int n = 0; n < 6; ++n) {
      const Index source = below(random, t.positions.size());
      solve(Serial{}, single, PointSource::at(source), at(Accuracy::accurate()), workspace, field);
      check(field.distance, source, 1e-3);
      if (n > 0) continue;
      solve(Serial{}, mesh, PointSource::at(source), at(Accuracy::exact()), exact_workspace, exact);
      check(exact.distance, source, 1e-9);
    }
  }
}

}  // namespace plexway::testing::accuracy_test
