#include <plexway/surface/intrinsic_delaunay.hpp>

#include <catch2/catch.hpp>
#include <cmath>
#include <random>

#include <plexway/error.hpp>

#include "complexes/surface/triangulation_testing.hpp"

namespace plexway::testing::intrinsic_map_test {

namespace {

template <class Barycentric>
Position place(const Surface& s, const Face& face, const Barycentric& b) {
  Position p{};
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t k = 0; k < 3; ++k) p[k] += b[i] * s.positions[face[i]][k];
  return p;
}

double apart(const Position& p, const Position& q) {
  return std::hypot(p[0] - q[0], p[1] - q[1], p[2] - q[2]);
}

std::array<double, 3> any_point(std::mt19937& random) {
  double u = uniform(random), v = uniform(random);
  if (u + v > 1) u = 1 - u, v = 1 - v;
  return {1 - u - v, u, v};
}

// Through the triangulation and back to where it came from.
double worst_round_trip(const Surface& s) {
  const IntrinsicDelaunay delaunay(s.mesh<double>());
  std::mt19937 random(1);
  double worst = 0;
  for (Index f = 0; f < s.faces.size(); ++f)
    for (int n = 0; n < 8; ++n) {
      auto b = any_point(random);
      if (n == 0) b = {0.5, 0.5, 0};  // on an edge
      const PointSource there = delaunay.to_intrinsic(PointSource::in(f, b));
      const PointSource back = delaunay.to_input(there);
      double sum = 0;
      for (const double x : there.barycentric) {
        CHECK(x >= 0);
        sum += x;
      }
      CHECK(sum == Approx(1).epsilon(1e-14));
      worst = std::max(
          worst, apart(place(s, s.faces[f], b), place(s, s.faces[back.simplex], back.barycentric)));
    }
  return worst;
}

}  // namespace

TEST_CASE("points of a plane lie in the intrinsic triangle around them") {
  for (unsigned seed = 1; seed <= 5; ++seed) {
    const Surface s = random_polygon(7, 120, 2000, seed);
    const IntrinsicDelaunay delaunay(s.mesh<double>());
    const Plain p = plain(delaunay.mesh<double>());
    std::mt19937 random(seed);
    double worst = 0;
    for (Index f = 0; f < s.faces.size(); ++f)
      for (int n = 0; n < 10; ++n) {
        const auto b = any_point(random);
        const PointSource there = delaunay.to_intrinsic(PointSource::in(f, b));
        worst = std::max(worst, apart(place(s, s.faces[f], b),
                                      place(s, p.faces[there.simplex], there.barycentric)));
        // And the other way, from any point of any triangle there.
        const PointSource here = delaunay.to_input(PointSource::in(f, b));
        worst = std::max(worst, apart(place(s, p.faces[f], b),
                                      place(s, s.faces[here.simplex], here.barycentric)));
      }
    CHECK(worst < 1e-12);
  }
}

TEST_CASE("points return from the intrinsic triangulation") {
  CHECK(worst_round_trip(random_polygon(6, 200, 5000, 2)) < 1e-9);
  CHECK(worst_round_trip(grid(9, 9, 1, 1e-6)) < 1e-9);
  CHECK(worst_round_trip(grid(9, 9, 1, 0)) < 1e-9);
  CHECK(worst_round_trip(prism(9, 4, 50)) < 1e-9);
  CHECK(worst_round_trip(moebius(40, 1)) < 1e-9);
  CHECK(worst_round_trip(renamed(moebius(40, 3), 2, true, true).surface) < 1e-9);
  CHECK(worst_round_trip(renamed(sheets(4, 5), 2, true, true).surface) < 1e-9);
  CHECK(worst_round_trip(soup(10, 60, 3)) < 1e-9);
}

TEST_CASE("vertices and offsets are kept by the map") {
  const Surface s = random_polygon(6, 30, 500, 4);
  const IntrinsicDelaunay delaunay(s.mesh<double>());
  PointSource source = PointSource::at(7);
  source.offset = 3;
  CHECK(delaunay.to_intrinsic(source).vertex == 7);
  CHECK(delaunay.to_intrinsic(source).offset == 3);
  source = PointSource::in(5, {0.2, 0.3, 0.5});
  source.offset = 2;
  CHECK(delaunay.to_intrinsic(source).offset == 2);
  CHECK(delaunay.to_input(delaunay.to_intrinsic(source)).offset == 2);
  source.simplex = static_cast<Index>(s.faces.size());
  CHECK_THROWS_AS(delaunay.to_intrinsic(source), UsageError);
  CHECK_THROWS_AS(delaunay.to_input(source), UsageError);
}

TEST_CASE("lines of the intrinsic triangulation are lines of the input") {
  const Surface s = random_polygon(6, 150, 3000, 5);
  const IntrinsicDelaunay delaunay(s.mesh<double>());
  const Plain p = plain(delaunay.mesh<double>());
  std::mt19937 random(6);
  std::size_t most = 0;
  for (Index f = 0; f < s.faces.size(); ++f)
    for (int n = 0; n < 4; ++n) {
      std::array<double, 3> from = any_point(random), to = any_point(random);
      if (n == 0) from = {1, 0, 0}, to = {0, 1, 0};  // an edge
      const Position start = place(s, p.faces[f], from), end = place(s, p.faces[f], to);
      const auto pieces = delaunay.line_to_input(f, from, to);
      most = std::max(most, pieces.size());
      REQUIRE(!pieces.empty());
      Position at = start;
      double length = 0;
      for (const auto& piece : pieces) {
        const Position a = place(s, s.faces[piece.face], piece.from),
                       b = place(s, s.faces[piece.face], piece.to);
        CHECK(apart(a, at) < 1e-12);
        length += apart(a, b);
        at = b;
      }
      CHECK(apart(at, end) < 1e-12);
      CHECK(length == Approx(apart(start, end)).epsilon(1e-9).margin(1e-12));
    }
  CHECK(most > 3);
}

TEST_CASE("refinement makes good triangles and keeps metric and map") {
  const Surface shapes[] = {noisy(sphere(3), 0.3, 4), prism(9, 3, 20), moebius(60, 1),
                            noisy(sheets(3, 4), 0.2, 1), random_polygon(6, 60, 800, 3)};
  for (const Surface& s : shapes) {
    const auto input = s.mesh<double>();
    // Points close to a boundary it surrounds with ever smaller triangles.
    const bool ends = s.positions.size() != 66;
    const IntrinsicDelaunay delaunay(input,
                                     {.smallest_angle = 20, .most_vertices = ends ? 50. : 2.});
    const auto mesh = delaunay.mesh<double>();
    const Plain p = plain(input), q = plain(mesh);
    CHECK(delaunay.summary().inserted_vertices > 0);
    CHECK(mesh.vertex_count() == input.vertex_count() + delaunay.summary().inserted_vertices);
    CHECK(worst_excess(mesh) < 1e-10);
    if (ends) CHECK(measure_triangulation(mesh).smallest_angle > 19.99);
    CHECK(delaunay.summary().inserted_vertices <= 50 * input.vertex_count());
    CHECK(total_area(q) == Approx(total_area(p)).epsilon(1e-10));
    const auto angles = cone_angles(p, input.vertex_count());
    const auto now = cone_angles(q, mesh.vertex_count());
    for (std::size_t v = 0; v < now.size(); ++v) {
      if (v < angles.size()) {
        CHECK(now[v] == Approx(angles[v]).epsilon(1e-10));
      } else {  // inside, or on the boundary
        const double turns = now[v] / std::numbers::pi;
        CHECK((std::abs(turns - 2) < 1e-10 || std::abs(turns - 1) < 1e-10));
      }
    }
    // Vertices put in are where edges to the input's vertices say they are: there and back.
    std::mt19937 random(2);
    double worst = 0;
    for (Index f = 0; f < s.faces.size(); ++f) {
      const auto b = any_point(random);
      const PointSource back = delaunay.to_input(delaunay.to_intrinsic(PointSource::in(f, b)));
      worst = std::max(
          worst, apart(place(s, s.faces[f], b), place(s, s.faces[back.simplex], back.barycentric)));
    }
    CHECK(worst < 1e-9);
    const PointSource last =
        delaunay.to_input(PointSource::at(static_cast<Index>(mesh.vertex_count() - 1)));
    REQUIRE(last.vertex == none);
    const PointSource there = delaunay.to_intrinsic(last);
    double most = 0;
    for (std::size_t i = 0; i < 3; ++i)
      if (q.faces[there.simplex][i] == mesh.vertex_count() - 1)
        most = std::max(most, there.barycentric[i]);
    CHECK(most == Approx(1).epsilon(1e-9));
  }
}

}  // namespace plexway::testing::intrinsic_map_test
