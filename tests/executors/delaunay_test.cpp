#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <filesystem>
#include <string>

#include <plexway/io/triangles.hpp>
#include <plexway/solve.hpp>
#include <plexway/surface/intrinsic_delaunay.hpp>

#include "complexes/surface/triangulation_testing.hpp"
#include "exact_data.hpp"
#include "with_accuracy.hpp"

namespace plexway::testing::delaunay_test {

namespace {

template <class Real>
double worst_in_plane(const Surface& s, const TriangleMesh<Real>& mesh, const PointSource& source,
                      const Position& at, Accuracy accuracy) {
  const auto field = solve(Serial{}, mesh, source, testing::at(accuracy));
  double worst = 0;
  for (std::size_t v = 0; v < s.positions.size(); ++v) {
    const double exact = std::hypot(s.positions[v][0] - at[0], s.positions[v][1] - at[1]);
    if (exact > 0)
      worst = std::max(worst, std::abs(static_cast<double>(field.distance[v]) - exact) / exact);
  }
  return worst;
}

// Absolute relative errors over all sources with exact answers beside the mesh, ascending.
struct Measured {
  double mean = 0, below = 0;
};
Measured measure(const std::string& name, bool flip, Accuracy accuracy = Accuracy::usual()) {
  const std::filesystem::path path = exact_file("surfaces", name + ".obj");
  const io::Triangles s = io::read_triangles(path);
  TriangleMesh<float> mesh(s.positions, s.triangles);
  if (flip) mesh = IntrinsicDelaunay(TriangleMesh<double>(s.positions, s.triangles)).mesh<float>();
  Measured result;
  std::size_t count = 0;
  for (const ExactAnswer& answer : exact_answers(path)) {
    const auto field =
        solve(Serial{}, mesh, PointSource::at(static_cast<Index>(answer.source)), at(accuracy));
    for (std::size_t v = 0; v < answer.distance.size(); ++v) {
      const double exact = answer.distance[v];
      if (!(exact > 0) || !std::isfinite(exact)) continue;
      const double error = (static_cast<double>(field.distance[v]) - exact) / exact;
      result.mean += std::abs(error);
      result.below = std::min(result.below, error);
      ++count;
    }
  }
  result.mean /= static_cast<double>(count);
  return result;
}

}  // namespace

TEST_CASE("distances in a plane are exact on the intrinsic Delaunay triangulation") {
  for (unsigned seed = 1; seed <= 4; ++seed) {
    const Surface s = random_polygon(6, 150, 3000, seed);
    const IntrinsicDelaunay delaunay(s.mesh<double>());
    const auto mesh = delaunay.mesh<double>();
    const Face& f = s.faces[40];
    Position at{};
    for (std::size_t k = 0; k < 3; ++k)
      at[k] = 0.2 * s.positions[f[0]][k] + 0.3 * s.positions[f[1]][k] + 0.5 * s.positions[f[2]][k];
    const PointSource source = delaunay.to_intrinsic(PointSource::in(40, {0.2, 0.3, 0.5}));
    for (const Accuracy accuracy : {Accuracy::fast(), Accuracy::exact(), Accuracy::usual()}) {
      const bool merged = accuracy == Accuracy::usual();
      CAPTURE(seed, accuracy.error());
      CHECK(worst_in_plane(s, mesh, PointSource::at(9), s.positions[9], accuracy) < 1e-12);
      CHECK(worst_in_plane(s, mesh, source, at, accuracy) < 1e-12);
      if (accuracy == Accuracy::exact()) continue;
      CHECK(worst_in_plane(s, delaunay.mesh<float>(), source, at, accuracy) <
            (merged ? 2e-4 : 1.5e-6));
    }
  }
}

TEST_CASE("a flat grid of 20 to 1 right triangles is exact either way") {
  const Surface s = grid(60, 60, 1200, 60);
  const IntrinsicDelaunay delaunay(s.mesh<double>());
  for (const Index v : {0u, 1800u, 930u})
    for (const auto& [accuracy, worst] : {std::pair(Accuracy::fast(), 1e-12),
                                          {Accuracy::exact(), 1e-12},
                                          {Accuracy::usual(), 5e-5}}) {
      CAPTURE(v, accuracy.error());
      for (const auto& mesh : {s.mesh<double>(), delaunay.mesh<double>()})
        CHECK(worst_in_plane(s, mesh, PointSource::at(v), s.positions[v], accuracy) < worst);
    }
}

TEST_CASE("distances on two copies of a triangle glued along their edges") {
  // Symmetric in its two sides: the way from corner to corner is the edge.
  const IntrinsicDelaunay delaunay(double_cover(std::sqrt(3.0), 1, 1));
  const auto mesh = delaunay.mesh<double>();
  const auto from_tip = solve(Serial{}, mesh, PointSource::at(0));
  CHECK(from_tip.distance[1] == Approx(std::sqrt(3.0)).epsilon(1e-12));
  CHECK(from_tip.distance[2] == Approx(1).epsilon(1e-12));
  const auto from_top = solve(Serial{}, mesh, PointSource::at(2));
  CHECK(from_top.distance[0] == Approx(1).epsilon(1e-12));
  CHECK(from_top.distance[1] == Approx(1).epsilon(1e-12));
}

TEST_CASE("thin triangles and regular grids are accurate after flips") {
  CHECK(measure("spot", true).mean <= 1e-4);
  CHECK(measure("spot", true, Accuracy::fast()).mean <= 2e-3);
  if (exact_file("surfaces", "t79741.obj").empty()) {
    WARN("measured on spot alone");
    return;
  }
  for (const char* const needles : {"t79741", "t908460"}) {
    CHECK(measure(needles, true).mean <= 2e-4);
    CHECK(measure(needles, true, Accuracy::fast()).mean <= 5e-3);
  }
  CHECK(measure("wavy_grid200", true).mean <= 1e-4);
  const Measured wavy = measure("wavy_grid200", true, Accuracy::fast());
  CHECK(wavy.mean <= 1.5e-3);
  CHECK(wavy.below >= -0.01);
}

}  // namespace plexway::testing::delaunay_test
