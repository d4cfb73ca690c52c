#include <array>
#include <catch2/catch.hpp>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>
#include <vector>

#include <plexway/error.hpp>
#include <plexway/fields/isosurfaces.hpp>

namespace plexway::isosurfaces_test {

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

}  // namespace plexway::isosurfaces_test
