#include <array>
#include <catch2/catch.hpp>
#include <cmath>
#include <limits>
#include <vector>

#include <plexway/solve.hpp>

namespace plexway::solid_sources_test {

namespace {

using Position = std::array<double, 3>;
using Corners = std::array<Index, 4>;

double distance(const Position& a, const Position& b) {
  return std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]);
}

}  // namespace

TEMPLATE_TEST_CASE("two sources in one tetrahedron both count", "", float, double) {
  const std::vector<Position> positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0},
                                           {0, 0, 1}, {1, 1, 1}, {-1, -1, -1}};
  const std::vector<Corners> tets = {{0, 1, 2, 3}, {4, 1, 2, 3}, {5, 0, 2, 3}};
  const TetMesh<TestType> mesh(positions, tets);
  const std::vector<PointSource> sources = {PointSource::in(0, {.7, .1, .1, .1}),
                                            PointSource::in(0, {.1, .7, .1, .1})};
  const std::array<Position, 2> at = {{{.1, .1, .1}, {.7, .1, .1}}};
  const auto field = solve(Serial{}, mesh, sources, {});
  for (Index v = 0; v < 5; ++v) {  // all of these are in sight of both
    const double first = distance(positions[v], at[0]), second = distance(positions[v], at[1]);
    CHECK(field.distance[v] == Approx(std::min(first, second)));
    CHECK(field.label[v] == (first < second ? 0u : 1u));
  }
}

TEST_CASE("a long row of blocks that touch at vertices is reached to its end") {
  std::vector<Position> positions = {{0, 0, 0}};
  std::vector<Corners> tets;
  const Index blocks = 200;
  for (Index k = 0; k < blocks; ++k) {  // from (k, k, k) to the next, with three points between
    const double x = k;
    const Index first = static_cast<Index>(positions.size() - 1);
    for (const Position& p : {Position{x + 1, x, x}, Position{x, x + 1, x}, Position{x, x, x + 1},
                              Position{x + 1, x + 1, x + 1}})
      positions.push_back(p);
    tets.push_back({first, first + 1, first + 2, first + 3});
    tets.push_back({first + 4, first + 1, first + 2, first + 3});
  }
  const TetMesh<double> mesh(positions, tets);
  const auto field = solve(Serial{}, mesh, PointSource::at(0));
  CHECK(field.complete);
  for (Index k = 1; k <= blocks; ++k)
    CHECK(field.distance[4 * k] == Approx(k * std::sqrt(3.)).epsilon(1e-9));
  for (const double d : field.distance) CHECK(d < std::numeric_limits<double>::infinity());
}

TEMPLATE_TEST_CASE("a stray vertex costs the others no digits", "", float, double) {
  std::vector<Position> positions = {
      {5e6, 5e6, 5e6}, {5e6 + 1, 5e6, 5e6}, {5e6, 5e6 + 1, 5e6}, {5e6, 5e6, 5e6 + 1}, {0, 0, 0}};
  const std::vector<Corners> tets = {{0, 1, 2, 3}};
  const TetMesh<TestType> mesh(positions, tets);
  const auto field = solve(Serial{}, mesh, PointSource::at(1));
  CHECK(field.distance[0] == Approx(1).epsilon(1e-6));
  CHECK(field.distance[2] == Approx(std::sqrt(2.)).epsilon(1e-6));
  CHECK(field.distance[4] == std::numeric_limits<TestType>::infinity());
}

}  // namespace plexway::solid_sources_test
