#include <catch2/catch.hpp>
#include <cmath>
#include <limits>
#include <random>

#include <plexway/error.hpp>
#include <plexway/surface/intrinsic_delaunay.hpp>

#include "complexes/surface/triangulation_testing.hpp"

namespace plexway::testing::refinement_test {

namespace {

Position place(std::span<const Position> positions, const Face& face,
               const std::array<double, 4>& b) {
  Position p{};
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t k = 0; k < 3; ++k) p[k] += b[i] * positions[face[i]][k];
  return p;
}

double apart(const Position& p, const Position& q) {
  return std::hypot(p[0] - q[0], p[1] - q[1], p[2] - q[2]);
}

// Corners, points on edges and inside: how far off they are in the plane, read in the triangles of
// the new triangulation and after the way back.
double worst_in_plane(const Surface& s, const Refinement& wanted) {
  const IntrinsicDelaunay delaunay(s.mesh<double>(), wanted);
  const auto mesh = delaunay.mesh<double>();
  const Plain now = plain(mesh);
  std::vector<Position> positions = s.positions;
  for (Index v = static_cast<Index>(positions.size()); v < mesh.vertex_count(); ++v) {
    const PointSource there = delaunay.to_input(PointSource::at(v));
    REQUIRE(there.vertex == none);
    positions.push_back(place(s.positions, s.faces[there.simplex], there.barycentric));
  }
  std::vector<std::array<double, 3>> points = {{0.2, 0.3, 0.5}, {0.9, 0.05, 0.05}};
  for (std::size_t i = 0; i < 3; ++i)
    for (const double x : {0., 0.1, 0.25, 0.5, 0.75, 0.8}) {
      points.push_back({});
      points.back()[i] = 1 - x, points.back()[(i + 1) % 3] = x;
    }
  double worst = 0;
  for (Index f = 0; f < s.faces.size(); ++f)
    for (const auto& b : points) {
      const PointSource from = PointSource::in(f, b), there = delaunay.to_intrinsic(from);
      const PointSource back = delaunay.to_input(there);
      const Position at = place(s.positions, s.faces[f], from.barycentric);
      worst =
          std::max({worst, apart(at, place(positions, now.faces[there.simplex], there.barycentric)),
                    apart(at, place(s.positions, s.faces[back.simplex], back.barycentric))});
    }
  return worst;
}

}  // namespace

TEST_CASE("points on edges and at corners keep their place in a refined plane") {
  // Circumcentres of right triangles lie on edges, and make flat triangles there.
  for (const double width : {1., 3., 10., 20., 1000.})
    for (const double height : {1., 0.7, 1.1}) {
      CAPTURE(width, height);
      CHECK(worst_in_plane(grid(6, 12, 6 * width, 12 * height), Refinement::moderate()) <
            1e-11 * width);
      CHECK(worst_in_plane(grid(3, 2, 3 * width, 2 * height),
                           {.smallest_angle = 25, .most_vertices = 5}) < 1e-11 * width);
    }
  for (unsigned seed = 1; seed <= 3; ++seed)
    CHECK(worst_in_plane(random_polygon(7, 60, 800, seed), Refinement::moderate()) < 1e-11);
}

TEST_CASE("points keep their place beside a flat triangle") {
  Surface s;
  s.add(0, 0), s.add(4, 0), s.add(2, 0), s.add(2, 3), s.add(1, -3);
  s.triangle(0, 1, 3), s.triangle(1, 0, 2), s.triangle(0, 4, 2), s.triangle(4, 1, 2);
  CHECK(worst_in_plane(s, {}) < 1e-14);
  CHECK(worst_in_plane(s, {.smallest_angle = 20, .most_vertices = 3}) < 1e-14);
}

TEST_CASE("refinement leaves no flat triangles at a boundary") {
  // A rhombus of four right triangles: the circumcentres lie on the boundary, but for rounding.
  std::mt19937 random(4);
  double least = 180;
  for (int k = 0; k < 300; ++k) {
    const double a = 6 * uniform(random), far = 3 + 3 * uniform(random),
                 near = 0.3 + 0.7 * uniform(random);
    Surface s;
    const auto add = [&](double x, double y) {
      s.add(x * std::cos(a) - y * std::sin(a), x * std::sin(a) + y * std::cos(a));
    };
    add(0, 0), add(far, 0), add(0, near), add(-far, 0), add(0, -near);
    for (Index i = 0; i < 4; ++i) s.triangle(0, 1 + i, 1 + (i + 1) % 4);
    const IntrinsicDelaunay delaunay(s.mesh<double>(),
                                     {.smallest_angle = 20, .most_vertices = 0.5});
    CHECK(delaunay.summary().inserted_vertices == 2);
    least = std::min(least, measure_triangulation(delaunay.mesh<double>()).smallest_angle);
  }
  CHECK(least > 1);
}

TEST_CASE("refinement that makes no sense is refused") {
  const auto mesh = grid(2, 2, 10, 1).mesh<double>();
  constexpr double infinity = std::numeric_limits<double>::infinity();
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  const auto tried = [&](const Refinement& wanted) { IntrinsicDelaunay(mesh, wanted); };
  for (const double angle : {-1., 60., 180., infinity, nan})
    CHECK_THROWS_AS(tried({.smallest_angle = angle}), UsageError);
  for (const double share : {-0.1, infinity, nan})
    CHECK_THROWS_AS(tried({.smallest_angle = 20, .most_vertices = share}), UsageError);
  for (const double edge : {-1e-3, nan})
    CHECK_THROWS_AS(tried({.smallest_angle = 20, .shortest_edge = edge}), UsageError);
  tried({.smallest_angle = 20, .most_vertices = 0});
  tried({.smallest_angle = 20, .most_vertices = 1e300});
  tried({.smallest_angle = 20, .shortest_edge = infinity});
}

}  // namespace plexway::testing::refinement_test
