#include <array>
#include <catch2/catch.hpp>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>
#include <vector>

#include <plexway/error.hpp>
#include <plexway/fields/fine_field.hpp>
#include <plexway/fields/isolines.hpp>
#include <plexway/fields/isosurfaces.hpp>

#include "complexes/test_meshes.hpp"

namespace plexway::testing::level_sets_test {

TEST_CASE("isolines of a height are level and as long as they should be") {
  const Surface s = sphere(4);
  std::vector<double> height;
  for (const Position& p : s.positions) height.push_back(p[2]);
  const double values[] = {-0.5, 0.25, 7};
  const auto lines = isolines(s.positions, s.faces, height, values);
  REQUIRE(lines.size() == 2);  // no value is reached at 7
  for (std::size_t n = 0; n < 2; ++n) {
    const Path& line = lines[n];
    CHECK(line.source == n);
    CHECK(line.positions.front() == line.positions.back());  // closed
    for (const Position& p : line.positions) CHECK(p[2] == Approx(values[n]).margin(1e-9));
    const double radius = std::sqrt(1 - values[n] * values[n]);
    CHECK(line.length == Approx(2 * std::numbers::pi * radius).epsilon(1e-2));
    // Each piece lies in the simplex of its first point.
    for (std::size_t i = 0; i + 1 < line.points.size(); ++i) {
      const PathPoint& at = line.points[i];
      for (std::size_t k = 0; k < 3; ++k) {
        double x = 0;
        for (std::size_t c = 0; c < 3; ++c)
          x += at.barycentric[c] * s.positions[s.faces[at.simplex][c]][k];
        CHECK(x == Approx(line.positions[i][k]).margin(1e-12));
      }
    }
  }
}

TEST_CASE("isolines end at the boundary and at what is not reached") {
  const Surface s = grid(10, 10);
  std::vector<double> x;
  for (const Position& p : s.positions) x.push_back(p[0]);
  const double value[] = {0.5};  // through vertices
  auto lines = isolines(s.positions, s.faces, x, value);
  REQUIRE(lines.size() == 1);
  CHECK(lines[0].length == Approx(1));
  x[s.nearest(0.5, 0.5)] = std::numeric_limits<double>::infinity();
  lines = isolines(s.positions, s.faces, x, value);
  CHECK(lines.size() == 2);
  CHECK_THROWS_AS(isolines(s.positions, s.faces, std::vector<double>(3), value), UsageError);
  const double no[] = {std::nan("")};
  CHECK_THROWS_AS(isolines(s.positions, s.faces, x, no), UsageError);
}

TEST_CASE("isolines inside large triangles are arcs") {
  // Two triangles, and the distance from a corner: every line is a quarter of a circle.
  const std::vector<Position> positions = {{0, 0, 0}, {4, 0, 0}, {4, 4, 0}, {0, 4, 0}};
  const std::vector<std::array<Index, 3>> faces = {{0, 1, 2}, {0, 2, 3}};
  const auto place = [&](Index face, const auto& weights) {
    Position at{};
    for (std::size_t i = 0; i < 3; ++i)
      for (std::size_t k = 0; k < 3; ++k) at[k] += weights[i] * positions[faces[face][i]][k];
    return at;
  };
  std::vector<double> distance;
  for (const Position& p : positions) distance.push_back(std::hypot(p[0], p[1]));
  const auto exact = [&](Index face, const std::array<double, 4>& weights) {
    const Position at = place(face, weights);
    return std::hypot(at[0], at[1]);
  };
  const double values[] = {3, 0.7};
  const auto lines = isolines(positions, faces, distance, values, exact, 1e-2);
  REQUIRE(lines.size() == 2);
  for (const Path& line : lines) {
    const double radius = values[line.source];
    CHECK(line.length == Approx(std::numbers::pi / 2 * radius).epsilon(1e-2));  // of chords
    REQUIRE(line.points.size() == line.positions.size());
    for (std::size_t i = 0; i < line.points.size(); ++i) {
      const Position& p = line.positions[i];
      CHECK(std::hypot(p[0], p[1]) == Approx(radius).epsilon(1e-11));
      const Position same = place(line.points[i].simplex, line.points[i].barycentric);
      for (std::size_t k = 0; k < 3; ++k) CHECK(same[k] == Approx(p[k]).margin(1e-12));
    }
  }
  // Linear, the outer one would be a chord through (3, 0) and the diagonal's point at 3.
  CHECK(isolines(positions, faces, distance, values)[0].length < 0.99 * std::numbers::pi / 2 * 3);
  CHECK_THROWS_AS(isolines(positions, faces, distance, values, exact, 0), UsageError);
}

TEST_CASE("a fine field fits together and is as exact as the one it is made of") {
  const Surface s = sphere(2);
  std::vector<double> height;
  for (const Position& p : s.positions) height.push_back(p[2] * p[2]);
  const auto inside = [&](Index face, const std::array<double, 4>& weights) {
    double z = 0;
    for (std::size_t i = 0; i < 3; ++i) z += weights[i] * s.positions[s.faces[face][i]][2];
    return z * z;
  };
  const FineField fine = fine_field(s.positions, s.faces, height, inside, {.tolerance = 1e-3});
  CHECK(fine.parts > 1);
  CHECK(fine.faces.size() == s.faces.size() * fine.parts * fine.parts);
  // Closed as before: Euler's number, so that no vertex is there twice.
  CHECK(fine.positions.size() + fine.faces.size() == 3 * fine.faces.size() / 2 + 2);
  for (std::size_t v = 0; v < fine.positions.size(); ++v)
    CHECK(fine.distance[v] == Approx(fine.positions[v][2] * fine.positions[v][2]).margin(1e-14));
}

namespace {

using Position = std::array<double, 3>;

// A box of n^3 cells from -1 to 1, six tetrahedra a cell.
struct Box {
  std::vector<Position> positions;
  std::vector<std::array<Index, 4>> tets;

  explicit Box(Index n) {
    const Index m = n + 1;
    for (Index z = 0; z < m; ++z)
      for (Index y = 0; y < m; ++y)
        for (Index x = 0; x < m; ++x)
          positions.push_back({2. * x / n - 1, 2. * y / n - 1, 2. * z / n - 1});
    const std::array<Index, 3> step = {1, m, m * m};
    constexpr std::size_t orders[6][3] = {{0, 1, 2}, {0, 2, 1}, {1, 0, 2},
                                          {1, 2, 0}, {2, 0, 1}, {2, 1, 0}};
    for (Index z = 0; z < n; ++z)
      for (Index y = 0; y < n; ++y)
        for (Index x = 0; x < n; ++x)
          for (const auto& order : orders) {
            std::array<Index, 4> tet = {x + m * (y + m * z), 0, 0, 0};
            for (std::size_t k = 0; k < 3; ++k) tet[k + 1] = tet[k] + step[order[k]];
            tets.push_back(tet);
          }
  }
};

double area(const Isosurfaces& s, std::size_t t, Position* normal = nullptr) {
  Position u, v;
  for (std::size_t k = 0; k < 3; ++k) {
    u[k] = s.positions[s.triangles[t][1]][k] - s.positions[s.triangles[t][0]][k];
    v[k] = s.positions[s.triangles[t][2]][k] - s.positions[s.triangles[t][0]][k];
  }
  const Position n = {u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2],
                      u[0] * v[1] - u[1] * v[0]};
  if (normal != nullptr) *normal = n;
  return std::sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]) / 2;
}

}  // namespace

TEST_CASE("isosurfaces of the distance from a point are spheres") {
  const Box box(40);
  std::vector<double> distance;
  for (const Position& p : box.positions) distance.push_back(std::hypot(p[0], p[1], p[2]));
  const double values[] = {0.3, 0.7, 9};
  const Isosurfaces s = isosurfaces(box.positions, box.tets, distance, values);
  REQUIRE(s.value.size() == s.positions.size());
  std::array<double, 3> areas = {0, 0, 0};
  bool outward = true;
  std::map<std::pair<Index, Index>, int> edges;
  for (std::size_t t = 0; t < s.triangles.size(); ++t) {
    Position normal;
    const Index n = s.value[s.triangles[t][0]];
    areas[n] += area(s, t, &normal);
    const Position& p = s.positions[s.triangles[t][0]];
    // Slivers have no direction.
    if (area(s, t) > 1e-9) outward &= normal[0] * p[0] + normal[1] * p[1] + normal[2] * p[2] > 0;
    for (std::size_t i = 0; i < 3; ++i)
      ++edges[std::minmax(s.triangles[t][i], s.triangles[t][(i + 1) % 3])];
  }
  for (std::size_t n = 0; n < 2; ++n)
    CHECK(areas[n] == Approx(4 * std::numbers::pi * values[n] * values[n]).epsilon(2e-2));
  CHECK(areas[2] == 0);
  CHECK(outward);
  // A distance r between the ends of an edge h is linear up to h^2 / 8 r.
  const double edge = 0.05 * std::sqrt(3.0);
  for (std::size_t v = 0; v < s.positions.size(); ++v) {
    const Position& p = s.positions[v];
    const double r = values[s.value[v]], off = std::hypot(p[0], p[1], p[2]) - r;
    CHECK(std::abs(off) <= 1.1 * edge * edge / (8 * r));
  }
  std::size_t open = 0;
  for (const auto& [ends, count] : edges) open += count != 2;
  CHECK(open == 0);  // closed
}

TEST_CASE("an isosurface through vertices is there once") {
  const Box box(4);
  std::vector<double> height;
  for (const Position& p : box.positions) height.push_back(p[2]);
  const double value[] = {0};  // a layer of vertices
  const Isosurfaces s = isosurfaces(box.positions, box.tets, height, value);
  double sum = 0;
  for (std::size_t t = 0; t < s.triangles.size(); ++t) {
    Position normal;
    sum += area(s, t, &normal);
    CHECK(normal[2] > 0);
  }
  CHECK(sum == Approx(4));
  CHECK(s.positions.size() == 25);
  CHECK(s.triangles.size() == 32);
}

TEST_CASE("isosurfaces end beside what is not reached and refuse what makes no sense") {
  const Box box(2);
  std::vector<double> height;
  for (const Position& p : box.positions) height.push_back(p[2]);
  const double value[] = {0.5};
  double whole = 0, less = 0;
  Isosurfaces s = isosurfaces(box.positions, box.tets, height, value);
  for (std::size_t t = 0; t < s.triangles.size(); ++t) whole += area(s, t);
  CHECK(whole == Approx(4));
  height.back() = std::numeric_limits<double>::infinity();
  s = isosurfaces(box.positions, box.tets, height, value);
  for (std::size_t t = 0; t < s.triangles.size(); ++t) less += area(s, t);
  CHECK(less == Approx(3));  // all six tetrahedra of the last cell have that corner
  const std::vector<double> few(3);
  CHECK_THROWS_AS(isosurfaces(box.positions, box.tets, few, value), UsageError);
  const double no[] = {std::nan("")};
  CHECK_THROWS_AS(isosurfaces(box.positions, box.tets, height, no), UsageError);
  const std::array<Index, 4> beyond[] = {{0, 1, 2, 99}};
  CHECK_THROWS_AS(isosurfaces(box.positions, beyond, height, value), UsageError);
}

}  // namespace plexway::testing::level_sets_test
