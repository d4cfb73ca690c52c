#include <catch2/catch.hpp>
#include <cmath>
#include <limits>
#include <random>

#include <plexway/error.hpp>
#include <plexway/surface/intrinsic_delaunay.hpp>

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

namespace {

Position place(std::span<const Position> positions, const Face& face,
               const std::array<double, 4>& b) {
  Position p{};
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t k = 0; k < 3; ++k) p[k] += b[i] * positions[face[i]][k];
  return p;
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

}  // namespace plexway::testing::intrinsic_map_test
