#include <catch2/catch.hpp>
#include <cmath>
#include <functional>
#include <random>

#include "complexes/test_meshes.hpp"

namespace plexway::testing::saddle_vertices_test {

// Which vertices bend paths is no matter of how finely a surface is cut.
namespace {

/// Of the corners, how many are at saddles.
double share_of_saddles(const Surface& s) {
  const TriangleMesh<float> mesh(s.positions, s.faces);
  std::size_t saddles = 0;
  for (const auto& t : mesh.triangles().first(mesh.face_count()))
    for (std::size_t i = 0; i < 3; ++i) saddles += t.saddle(i);
  return static_cast<double>(saddles) / (3 * static_cast<double>(mesh.face_count()));
}

/// Points of a grid that is moved a little within the plane, lifted, turned and rounded.
Surface lifted(Index n, double digit, const std::function<Position(double, double)>& lift) {
  std::mt19937 random(n);
  Surface s = grid(n, n);
  for (Position& p : s.positions) {
    const bool rim = p[0] == 0 || p[0] == 1 || p[1] == 0 || p[1] == 1;
    const double by = rim ? 0 : 0.3 / n;
    p = lift(p[0] + by * (2 * uniform(random) - 1), p[1] + by * (2 * uniform(random) - 1));
    p = {0.8 * p[0] + 0.6 * p[2], p[1], 0.8 * p[2] - 0.6 * p[0]};
    p = {p[0], 0.8 * p[1] + 0.6 * p[2], 0.8 * p[2] - 0.6 * p[1]};
    if (digit > 0)
      for (double& x : p) x = std::round(x / digit) * digit;
  }
  return s;
}

}  // namespace

TEST_CASE("a surface that is a saddle everywhere has saddles however flat or fine it is") {
  // Excess is curvature times area: 2.5e-3 to 1.6e-6 here, where less than 1e-5 may be rounding.
  for (const double height : {0.5, 0.2, 0.08})
    for (const Index n : {20, 60, 120}) {
      CAPTURE(height, n);
      const Surface s = lifted(n, 0, [&](double x, double y) {
        return Position{x, y, height * (x * x - y * y)};
      });
      // Vertices on the boundary, 4 / n of all, have other reasons.
      CHECK(share_of_saddles(s) > 0.9 - 4.0 / n);
    }
}

TEST_CASE("the share of saddles stays under refinement where curvature changes its sign") {
  const auto egg_box = [](double x, double y) {
    return Position{x, y, 0.02 * std::sin(9 * x) * std::sin(7 * y + 1)};
  };
  const double coarse = share_of_saddles(lifted(40, 0, egg_box));
  CHECK(coarse > 0.3);
  CHECK(coarse < 0.7);
  for (const Index n : {80, 160, 320}) {
    CAPTURE(n);
    CHECK(share_of_saddles(lifted(n, 0, egg_box)) == Approx(coarse).margin(0.05));
    // As files in single precision have it.
    CHECK(share_of_saddles(lifted(n, 1e-7, egg_box)) == Approx(coarse).margin(0.05));
  }
}

TEST_CASE("rounding of coordinates makes no saddles where a surface unrolls") {
  for (const Index n : {40, 150})
    for (const double digit : {0., 1e-7, 1e-6}) {
      CAPTURE(n, digit);
      const auto plane = [](double x, double y) { return Position{x, y, 0}; };
      // Moved along the straight lines on it only: else it does not unroll.
      const auto cylinder = [&](double x, double y) {
        x = std::round(x * n) / n;
        return Position{std::cos(x), std::sin(x), y};
      };
      CHECK(share_of_saddles(lifted(n, digit, plane)) < 0.02);
      CHECK(share_of_saddles(lifted(n, digit, cylinder)) < 0.02);
    }
}

}  // namespace plexway::testing::saddle_vertices_test
