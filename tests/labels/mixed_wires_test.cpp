#include <algorithm>
#include <array>
#include <catch2/catch.hpp>
#include <cmath>
#include <cstddef>
#include <random>
#include <utility>
#include <vector>

#include <plexway/solve.hpp>

#include "mixed_domains.hpp"

namespace mixed_wires_test {

// Many wires in a solid.

namespace {

using namespace mixed_domains;

/// Wires along lines of vertices of a block, whose inner vertices are moved at random.
struct Wired {
  Wired(std::size_t n, std::size_t wires, double speed, unsigned seed) : domain(seed), c(speed) {
    std::mt19937 random(seed + 1);
    std::uniform_real_distribution<double> uniform(-.15 / double(n), .15 / double(n));
    Block all = block({0, 0, 0}, {1, 1, 1}, n);
    for (Position& p : all.positions)
      for (double& x : p)
        if (x > 1e-9 && x < 1 - 1e-9) x += uniform(random);
    solid = domain.add(all);
    for (std::size_t w = 0; w < wires; ++w) {
      const std::size_t m = n + 1, i = random() % m, j = random() % m, axis = random() % 3;
      std::vector<Position> line;
      for (std::size_t k = 0; k < m; ++k) {
        const std::array<std::size_t, 3> at[3] = {{i, j, k}, {k, i, j}, {j, k, i}};
        line.push_back(all.positions[(at[axis][0] * m + at[axis][1]) * m + at[axis][2]]);
      }
      rods.push_back(domain.add(rod(line), speed));
      domain.weld(solid, rods.back());
    }
  }

  /// Legs are straight in the block or along wires, which they come to and leave at vertices and at
  /// `parts` - 1 points of each edge: as many as are needed.
  [[nodiscard]] std::vector<double> times(Index source, std::size_t parts) const {
    std::vector<Position> at(domain.positions.begin(), domain.positions.end());
    const std::size_t vertices = at.size();
    std::vector<std::array<Index, 2>> edges;  // along wires
    for (const auto& rod : rods)
      for (Index v = rod.first_vertex + 1; v < rod.first_vertex + rod.vertices; ++v) {
        Index last = v - 1;
        for (std::size_t k = 1; k < parts; ++k) {
          const double share = double(k) / double(parts);
          Position p;
          for (std::size_t i = 0; i < 3; ++i)
            p[i] = at[v - 1][i] + share * (at[v][i] - at[v - 1][i]);
          at.push_back(p);
          edges.push_back({last, Index(at.size() - 1)});
          last = Index(at.size() - 1);
        }
        edges.push_back({last, v});
      }
    std::vector<std::vector<Index>> beside(at.size());
    for (const auto& [v, w] : edges) beside[v].push_back(w), beside[w].push_back(v);
    std::vector<double> time(at.size(), infinity);
    std::vector<Index> open = {source};
    for (Index v = solid.vertices; v < at.size(); ++v) open.push_back(v);
    time[source] = 0;
    while (!open.empty()) {
      const auto next = std::min_element(open.begin(), open.end(),
                                         [&](Index v, Index w) { return time[v] < time[w]; });
      const Index u = *next;
      *next = open.back();
      open.pop_back();
      for (Index v = 0; v < solid.vertices; ++v)
        time[v] = std::min(time[v], time[u] + distance(at[u], at[v]));
      for (const Index v : open) time[v] = std::min(time[v], time[u] + distance(at[u], at[v]));
      for (const Index v : beside[u])
        time[v] = std::min(time[v], time[u] + distance(at[u], at[v]) / c);
    }
    time.resize(vertices);
    return time;
  }

  Welded domain;
  double c;
  Welded::Piece solid{};
  std::vector<Welded::Piece> rods;
};

}  // namespace

TEST_CASE("wires of any speed in a block") {
  for (const double c : {.5, 1., 2., 5.})
    for (unsigned seed = 0; seed < 3; ++seed) {
      const Wired wired(8, 20, c, seed);
      const Index source = static_cast<Index>(wired.solid.vertices / 2 + 3 + seed);
      const std::vector<double> times = wired.times(source, c > 1 ? 8 : 1);
      const Errors e = errors(wired.domain, source, [&](Index v) { return times[v]; });
      CAPTURE(c, seed, e.mean, e.worst, e.low);
      // Where wires cross, strings of single vertices are lost; and the truth is coarse.
      CHECK(e.mean < (c > 1 ? 5e-4 : 1e-14));
      CHECK(e.worst < (c > 1 ? 2e-2 : 1e-12));
      CHECK(e.low > (c > 1 ? -2e-3 : -1e-12));
    }
}

TEST_CASE("wires hear of each other at a vertex of a solid that nothing else gains by") {
  // Three wires meet in the corner of a block; one of them reaches it long before the block does.
  Welded domain(5);
  const auto solid = domain.add(block({0, 0, 0}, {1, 1, 1}, 4));
  const auto to = domain.add(rod({{1, 0, 0}, {.75, 0, 0}, {.5, 0, 0}, {.25, 0, 0}, {0, 0, 0}}), 8);
  const auto up = domain.add(rod({{0, 0, 0}, {0, 0, .25}, {0, 0, .5}, {0, 0, .75}, {0, 0, 1}}), 8);
  const auto out = domain.add(rod({{0, 0, 0}, {0, -1, 0}, {0, -2, 0}}), 2);
  for (const auto& wire : {to, up, out}) domain.weld(solid, wire);
  const auto field = solve(Serial{}, domain.complex, PointSource::at(to.vertex(0)));
  const auto time = [&](Index v) { return field.distance[v] / domain.move.scale; };
  CHECK(time(to.vertex(4)) == Approx(1 / 8.).epsilon(1e-12));
  CHECK(time(up.vertex(4)) == Approx(2 / 8.).epsilon(1e-12));
  CHECK(time(out.vertex(2)) == Approx(1 / 8. + 1).epsilon(1e-12));
}

}  // namespace mixed_wires_test
