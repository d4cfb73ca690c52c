#include <catch2/catch.hpp>

#include <queue>
#include <utility>

#include "labels/simplex_testing.hpp"

namespace plexway::testing::simplex_peers_test {

namespace {

struct Graph {
  std::size_t vertices;
  std::vector<std::array<Index, 2>> edges;
  std::vector<std::array<double, 1>> lengths;
};

Graph random_graph(std::size_t vertices, std::size_t edges, unsigned seed) {
  std::mt19937 random(seed);
  Graph g{vertices, {}, {}};
  std::vector<std::pair<Index, Index>> seen;
  while (g.edges.size() < edges) {
    const Index a = below(random, vertices), b = below(random, vertices);
    const auto ends = std::pair<Index, Index>(std::minmax(a, b));
    if (a == b || std::find(seen.begin(), seen.end(), ends) != seen.end()) continue;
    seen.push_back(ends);
    g.edges.push_back({a, b});
    g.lengths.push_back({uniform(random) < .05 ? 0 : .1 + uniform(random)});
  }
  return g;
}

std::vector<double> dijkstra(const Graph& g, Index source) {
  std::vector<std::vector<std::pair<Index, double>>> next(g.vertices);
  for (std::size_t e = 0; e < g.edges.size(); ++e) {
    next[g.edges[e][0]].emplace_back(g.edges[e][1], g.lengths[e][0]);
    next[g.edges[e][1]].emplace_back(g.edges[e][0], g.lengths[e][0]);
  }
  std::vector<double> d(g.vertices, std::numeric_limits<double>::infinity());
  std::priority_queue<std::pair<double, Index>> queue;
  d[source] = 0;
  for (queue.emplace(0, source); !queue.empty();) {
    const auto [negative, v] = queue.top();
    queue.pop();
    if (-negative > d[v]) continue;
    for (const auto& [w, l] : next[v])
      if (d[v] + l < d[w]) queue.emplace(-(d[w] = d[v] + l), w);
  }
  return d;
}

}  // namespace

TEMPLATE_TEST_CASE("one dimension is Dijkstra's", "", float, double) {
  for (const unsigned seed : {1u, 2u, 3u})
    for (const std::size_t edges : {250u, 400u, 2000u}) {
      const Graph g = random_graph(300, edges, seed);
      const SimplicialComplex<TestType, 1> domain(g.vertices, g.edges, g.lengths);
      for (const Schedule schedule : schedules)
        for (const Visibility visibility : {Visibility::saddles, Visibility::upper_bound}) {
          PropagateOptions options;
          options.schedule = schedule;
          options.visibility = visibility;
          const Index source = g.edges[0][0];
          const Errors e =
              compare(solve(domain, PointSource::at(source), options), dijkstra(g, source));
          CAPTURE(seed, edges, name(options), e.max);
          CHECK(e.fits);
          CHECK(e.max < (sizeof(TestType) == 4 ? 2e-6 : 5e-15));
        }
    }
}

TEST_CASE("a source on an edge of a graph goes both ways") {
  const std::array<Index, 2> edges[] = {{2, 0}, {1, 2}, {0, 1}};
  const std::array<double, 1> lengths[] = {{4.}, {3.}, {2.}};
  const SimplicialComplex<double, 1> ring(3, edges, lengths);
  const auto d = solve(ring, PointSource::in(0, {.75, .25}));  // 1 from vertex 2, 3 from vertex 0
  CHECK(d[2] == Approx(1).epsilon(1e-14));
  CHECK(d[0] == Approx(3).epsilon(1e-14));
  CHECK(d[1] == Approx(4).epsilon(1e-14));
}

TEST_CASE("two dimensions agree with the plain rule of surfaces") {
  // With the nearest first both take the same steps.
  Surface hills =
      cut(grid(25, 25), [](double x, double y) { return std::hypot(x - .41, y - .63) > .13; });
  Surface ball = sphere(3);
  std::mt19937 random(3);
  for (Position& p : hills.positions)
    p = {p[0] + .01 * uniform(random), p[1] + .01 * uniform(random),
         .2 * std::sin(7 * p[0]) * std::cos(6 * p[1])};
  for (Position& p : ball.positions)
    for (double& x : p) x += .02 * uniform(random);
  Surface fans = sheets(3, 9);  // regular: here lines pass through vertices
  for (const Surface& s : {hills, ball, random_polygon(6, 80, 200, 3), fans})
    for (const Visibility visibility : {Visibility::centroid, Visibility::upper_bound})
      for (const PointSource& source : {PointSource::at(5), PointSource::in(7, {.2, .3, .5})}) {
        PropagateOptions options;
        options.schedule = Schedule::priority;
        options.visibility = visibility;
        std::vector<double> flat;
        for (const Position& p : s.positions) flat.insert(flat.end(), p.begin(), p.end());
        const SimplicialComplex<double, 2> domain(flat, 3, s.faces);
        const auto d = solve(domain, source, options);
        const auto plain = solve(s.mesh<double>(), source, options);
        const Errors e = compare(d, plain);
        CAPTURE(s.positions.size(), name(options), source.vertex, e.mean, e.max);
        CHECK(e.fits);
        if (s.positions.size() != fans.positions.size()) {
          CHECK(e.max < 1e-11);
        } else {
          // PlainRule leaves it to rounding whether they pass; here they do, and paths are shorter.
          CHECK(e.mean < .03);
          double more = 0;
          for (std::size_t v = 0; v < d.size(); ++v) more += d[v] - plain[v];
          CHECK(more <= 0);
        }
      }
}

}  // namespace plexway::testing::simplex_peers_test
