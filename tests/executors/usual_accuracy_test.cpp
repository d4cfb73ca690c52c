// What distances are worth to who asks for nothing in particular, beside exact ones.

#include <algorithm>
#include <catch2/catch.hpp>

#include <plexway/error.hpp>
#include <plexway/io/triangles.hpp>
#include <plexway/solve.hpp>

#include "complexes/test_meshes.hpp"
#include "exact_data.hpp"
#include "labels/solving.hpp"
#include "with_accuracy.hpp"

namespace plexway::testing::usual_accuracy_test {

namespace {

std::vector<double> exact_distances(const Surface& s, Index source) {
  return solve(s.mesh<double>(), PointSource::at(source), at(Accuracy::exact()));
}

/// A sphere without its cap, whose smooth rim is concave as seen along the surface: paths creep
/// along it.
Surface bowl() {
  const Surface whole = sphere(4);
  Surface s;
  std::vector<Index> number(whole.positions.size(), none);
  for (const Face& f : whole.faces) {
    if (std::any_of(f.begin(), f.end(), [&](Index v) { return whole.positions[v][2] > .6; }))
      continue;
    Face kept{};
    for (std::size_t i = 0; i < 3; ++i) {
      const Position& p = whole.positions[f[i]];
      if (number[f[i]] == none) number[f[i]] = s.add(p[0], p[1], p[2]);
      kept[i] = number[f[i]];
    }
    s.faces.push_back(kept);
  }
  return s;
}

}  // namespace

TEST_CASE("by default a tube that winds is right from where labels are far off") {
  const io::Triangles knot = io::read_triangles(PLEXWAY_SOURCE_DIR "/data/knot.ply");
  const Surface s = {knot.positions, knot.triangles};
  const std::vector<double> exact = exact_distances(s, 840);
  const auto mesh = s.mesh<float>();
  const Errors labels = compare(solve(mesh, PointSource::at(840), by_labels()), exact);
  CHECK(labels.below < -0.2);  // else there is nothing to see here
  const Errors usual = compare(solve(mesh, PointSource::at(840)), exact);
  CAPTURE(usual.mean, usual.max);
  CHECK(usual.fits);
  CHECK(usual.mean <= 2e-4);
  CHECK(usual.max <= 5e-3);
  const auto several = plexway::solve(OpenMP{2}, mesh, PointSource::at(840));
  CHECK(compare(several.distance, exact).max == usual.max);
}

TEMPLATE_TEST_CASE("by default paths creep along a smooth rim", "", float, double) {
  const Surface s = bowl();
  const auto mesh = s.mesh<TestType>();
  for (const Index source : {s.nearest(.8, 0), s.nearest(-.5, .6), Index{5}}) {
    const std::vector<double> exact = exact_distances(s, source);
    const Errors usual = compare(solve(mesh, PointSource::at(source)), exact);
    CAPTURE(source, usual.mean, usual.max);
    CHECK(usual.fits);
    CHECK(usual.mean <= 2e-4);
    CHECK(usual.max <= 5e-3);
  }
}

TEST_CASE("by default real surfaces are near their exact distances") {
  for (const char* const name : {"spot", "fandisk", "beetle_car", "rocker-arm"}) {
    const std::filesystem::path file = exact_file("surfaces", std::string(name) + ".obj");
    if (file.empty()) continue;
    const io::Triangles read = io::read_triangles(file);
    const TriangleMesh<float> mesh(read.positions, read.triangles);
    for (const ExactAnswer& answer : exact_answers(file)) {
      const Errors e =
          compare(solve(mesh, PointSource::at(static_cast<Index>(answer.source))), answer.distance);
      CAPTURE(name, answer.source, e.mean, e.max);
      CHECK(e.mean <= 2e-4);
      CHECK(e.max <= 5e-3);
    }
  }
}

TEST_CASE("where windows become too many labels take over, or it is said") {
  // Triangles thrown together: many on an edge, so that light comes back to where it was.
  for (const auto& [points, seed] : {std::pair(10u, 52u), {6u, 45u}}) {
    const Surface s = soup(points, 60, seed);
    const auto mesh = s.mesh<double>();
    const PointSource source = PointSource::at(s.faces[0][0]);
    CAPTURE(points, seed);
    CHECK_THROWS_AS(plexway::solve(Serial{}, mesh, source, at(Accuracy::exact())), EndlessError);
    CHECK_THROWS_WITH(plexway::solve(Serial{}, mesh, source, at(Accuracy::accurate())),
                      Catch::Contains("use the accuracy fast"));
    const auto usual = plexway::solve(Serial{}, mesh, source);
    CHECK(usual.statistics.windows_gave_up == 1);
    CHECK(usual.accuracy == Accuracy::fast());
    CHECK(usual.error.empty());
    const auto fast = plexway::solve(Serial{}, mesh, source, by_labels());
    CHECK(fast.statistics.windows_gave_up == 0);
    CHECK(usual.distance == fast.distance);
    // Balls about it as well, and the next field has nothing of it.
    const auto ball = plexway::solve(Serial{}, mesh, Source(BallSource{.centre = source}));
    CHECK(ball.statistics.windows_gave_up == 1);
    CHECK(ball.accuracy == Accuracy::fast());
    Workspace<double> workspace;
    DistanceField<double> field;
    const auto flat = grid(5, 5).mesh<double>();
    plexway::solve(Serial{}, mesh, std::span(&source, 1), {}, workspace, field);
    const PointSource corner = PointSource::at(0);
    plexway::solve(Serial{}, flat, std::span(&corner, 1), {}, workspace, field);
    CHECK(field.statistics.windows_gave_up == 0);
    CHECK(field.accuracy == Accuracy::accurate());
  }
}

}  // namespace plexway::testing::usual_accuracy_test
