#include <algorithm>
#include <array>
#include <catch2/catch.hpp>
#include <cmath>
#include <cstddef>
#include <limits>
#include <random>
#include <span>
#include <type_traits>
#include <utility>
#include <vector>

#include <plexway/boost_graph/dijkstra.hpp>
#include <plexway/error.hpp>

#include "complexes/test_wires.hpp"

namespace dijkstra_test {

using plexway::Index;
using plexway::boost_graph::EdgeDijkstra;
using plexway::boost_graph::EdgeGraph;

namespace {

constexpr double inf = std::numeric_limits<double>::infinity();

struct Soup {
  std::vector<std::array<double, 3>> positions;
  std::vector<std::array<Index, 3>> faces;
};

// Any triangles between random points: shared edges, islands and lone vertices come by themselves.
Soup random_soup(std::size_t vertices, std::size_t faces, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> coordinate(-1, 1);
  std::uniform_int_distribution<Index> vertex(0, static_cast<Index>(vertices - 1));
  Soup soup;
  for (std::size_t i = 0; i < vertices; ++i)
    soup.positions.push_back({coordinate(random), coordinate(random), coordinate(random)});
  for (std::size_t i = 0; i < faces; ++i) {
    const Index a = vertex(random);
    const Index b = vertex(random);
    const Index c = vertex(random);
    soup.faces.push_back({a, b, c});  // the same vertex twice happens, and is allowed
  }
  return soup;
}

Soup grid(Index n) {
  Soup soup;
  for (Index i = 0; i < n; ++i)
    for (Index j = 0; j < n; ++j) soup.positions.push_back({1.0 * i, 1.0 * j, 0});
  for (Index i = 0; i + 1 < n; ++i)
    for (Index j = 0; j + 1 < n; ++j) {
      const Index a = i * n + j;
      soup.faces.push_back({a, a + n, a + n + 1});
      soup.faces.push_back({a, a + n + 1, a + 1});
    }
  return soup;
}

// Settle the nearest vertex that is not settled, by a search through all; relax its edges.
std::vector<double> textbook(const Soup& soup, Index source) {
  const std::size_t n = soup.positions.size();
  std::vector<std::vector<std::pair<Index, double>>> edges(n);
  for (const auto& face : soup.faces)
    for (const Index a : face)
      for (const Index b : face) {
        double square = 0;
        for (std::size_t k = 0; k < 3; ++k)
          square += std::pow(soup.positions[a][k] - soup.positions[b][k], 2);
        edges[a].emplace_back(b, std::sqrt(square));
      }
  std::vector<double> distance(n, inf);
  std::vector<bool> settled(n, false);
  distance[source] = 0;
  for (;;) {
    std::size_t nearest = n;
    for (std::size_t v = 0; v < n; ++v)
      if (!settled[v] && distance[v] < inf && (nearest == n || distance[v] < distance[nearest]))
        nearest = v;
    if (nearest == n) return distance;
    settled[nearest] = true;
    for (const auto& [to, length] : edges[nearest])
      if (distance[nearest] + length < distance[to]) distance[to] = distance[nearest] + length;
  }
}

template <class Real>
double worst_difference(std::span<const Real> found, const std::vector<double>& expected) {
  REQUIRE(found.size() == expected.size());
  double worst = 0;
  for (std::size_t v = 0; v < found.size(); ++v) {
    const auto distance = static_cast<double>(found[v]);
    if (distance == expected[v]) continue;  // both +inf included
    const double difference = std::abs(distance - expected[v]) / (1 + expected[v]);
    worst = std::isfinite(difference) ? std::max(worst, difference) : inf;
  }
  return worst;
}

}  // namespace

TEMPLATE_TEST_CASE("Boost's Dijkstra agrees with the textbook's", "", float, double) {
  const double tolerance = 20 * static_cast<double>(std::numeric_limits<TestType>::epsilon());
  const Soup soup = GENERATE(random_soup(40, 12, 1), random_soup(60, 30, 2),
                             random_soup(80, 200, 3), random_soup(200, 250, 4), grid(9));
  EdgeDijkstra<TestType> dijkstra(soup.positions, soup.faces);
  for (Index source = 0; source < soup.positions.size(); source += 7) {
    dijkstra.run(source);
    REQUIRE(dijkstra.distance()[source] == 0);
    REQUIRE(worst_difference(dijkstra.distance(), textbook(soup, source)) <= tolerance);
    dijkstra.run_without_colours(source);
    REQUIRE(worst_difference(dijkstra.distance(), textbook(soup, source)) <= tolerance);
  }
}

TEST_CASE("Dijkstra's distances are infinite before a run and where no edge leads") {
  Soup soup = grid(3);
  soup.positions.push_back({5, 5, 5});
  EdgeDijkstra<double> dijkstra(soup.positions, soup.faces);
  for (const double d : dijkstra.distance()) CHECK(d == inf);
  dijkstra.run(0);
  CHECK(dijkstra.distance()[8] == Approx(2 * std::sqrt(2.0)));
  CHECK(dijkstra.distance()[9] == inf);
  dijkstra.run(9);
  CHECK(dijkstra.distance()[9] == 0);
  CHECK(dijkstra.distance()[0] == inf);
}

TEMPLATE_TEST_CASE("Dijkstra on the edges of any graph", "", float, double) {
  for (const unsigned seed : {1u, 2u, 3u}) {
    const auto wires = plexway::testing::random_wires(seed, 90, 140);
    const plexway::boost_graph::EdgeGraph graph(wires.vertices, wires.edges, wires.lengths);
    EdgeDijkstra<TestType> dijkstra(graph);
    const auto exact = plexway::testing::edge_distances(wires, 4);
    dijkstra.run(4);
    CHECK(worst_difference(dijkstra.distance(), exact) < 1e-6);
    dijkstra.run_without_colours(4);
    CHECK(worst_difference(dijkstra.distance(), exact) < 1e-6);
  }
}

TEST_CASE("Dijkstra can be moved and does not copy") {
  STATIC_REQUIRE(std::is_nothrow_move_constructible_v<EdgeDijkstra<float>>);
  STATIC_REQUIRE_FALSE(std::is_copy_constructible_v<EdgeDijkstra<float>>);
  const Soup soup = grid(3);
  EdgeDijkstra<float> first(soup.positions, soup.faces);
  EdgeDijkstra<float> second(std::move(first));
  second.run(4);
  CHECK(second.distance()[4] == 0);
  CHECK(second.bytes() > 0);
}

TEST_CASE("Dijkstra refuses what is not a surface, and a source that is not there") {
  Soup soup = grid(3);
  EdgeDijkstra<float> dijkstra(soup.positions, soup.faces);
  CHECK_THROWS_AS(dijkstra.run(9), plexway::UsageError);
  soup.positions[4][1] = 1e39;  // beyond float, within double
  CHECK_THROWS_AS(EdgeDijkstra<float>(soup.positions, soup.faces), plexway::InputError);
  CHECK_NOTHROW(EdgeDijkstra<double>(soup.positions, soup.faces));
  soup.positions[4][1] = std::numeric_limits<double>::quiet_NaN();
  CHECK_THROWS_AS(EdgeDijkstra<double>(soup.positions, soup.faces), plexway::InputError);
  soup = grid(3);
  soup.faces[3][2] = 9;
  CHECK_THROWS_WITH(EdgeDijkstra<double>(soup.positions, soup.faces),
                    Catch::Contains("face 3") && Catch::Contains("vertex 9"));
}

TEST_CASE("Dijkstra takes edges with lengths of their own") {
  // 0 -1- 1 -1- 2, a shortcut of 1.5 beside an edge of 5, a loop, and vertex 3 apart.
  const std::vector<std::array<Index, 2>> edges = {{0, 1}, {2, 1}, {0, 2}, {2, 0}, {1, 1}};
  const std::vector<double> lengths = {1, 1, 5, 1.5, 0.25};
  EdgeDijkstra<float> dijkstra(EdgeGraph(4, edges, lengths));
  dijkstra.run(0);
  CHECK(std::vector<float>(dijkstra.distance().begin(), dijkstra.distance().end()) ==
        std::vector<float>{0, 1, 1.5F, static_cast<float>(inf)});
  dijkstra.run_without_colours(2);
  CHECK(dijkstra.distance()[0] == 1.5F);
  CHECK(dijkstra.distance()[1] == 1);

  CHECK_THROWS_AS(EdgeGraph(2, edges, lengths), plexway::InputError);
  CHECK_THROWS_AS(EdgeGraph(4, edges, std::vector<double>{1, 1, 5, 1, -1}), plexway::InputError);
  const EdgeGraph too_long(4, edges, std::vector<double>{1, 1, 5, 1, 1e300});
  CHECK_THROWS_AS(EdgeDijkstra<float>(too_long), plexway::InputError);
}

TEST_CASE("Dijkstra on the edges of a surface and on the surface agree") {
  const Soup soup = random_soup(60, 80, 5);
  std::vector<std::array<Index, 2>> edges;
  std::vector<double> lengths;
  for (const auto& face : soup.faces)
    for (std::size_t i = 0; i < 3; ++i) {
      const Index a = face[i];
      const Index b = face[(i + 1) % 3];
      edges.push_back({a, b});
      lengths.push_back(std::hypot(soup.positions[a][0] - soup.positions[b][0],
                                   soup.positions[a][1] - soup.positions[b][1],
                                   soup.positions[a][2] - soup.positions[b][2]));
    }
  EdgeDijkstra<double> dijkstra(EdgeGraph(soup.positions.size(), edges, lengths));
  dijkstra.run(7);
  CHECK(worst_difference(dijkstra.distance(), textbook(soup, 7)) <= 1e-14);
}

}  // namespace dijkstra_test
