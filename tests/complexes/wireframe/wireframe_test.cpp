#include <plexway/wireframe/wireframe.hpp>

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <limits>
#include <random>

#include <plexway/error.hpp>

#include "complexes/test_wires.hpp"
#include "complexes/wireframe/vertex_order.hpp"

namespace plexway::testing::wireframe_test {

using Catch::Contains;

namespace {

constexpr double inf = std::numeric_limits<double>::infinity();
constexpr double no_number = std::numeric_limits<double>::quiet_NaN();

using Positions = std::vector<Position>;
using Edges = std::vector<std::array<Index, 2>>;
using Lengths = std::vector<double>;

template <class... Arguments>
std::string complaint(const Arguments&... arguments) {
  try {
    Wireframe<float> wireframe(arguments...);
  } catch (const InputError& error) {
    return error.what();
  }
  return "no complaint";
}

}  // namespace

TEMPLATE_TEST_CASE("a wireframe counts what it is made of", "", float, double) {
  // A square with a diagonal of two edges, a loop, a point of no length, and a lone vertex.
  const Positions p = {{0, 0, 0}, {3, 0, 0}, {3, 3, 0}, {0, 3, 0}, {9, 9, 9}, {5, 5, 0}, {5, 5, 0}};
  const Edges e = {{0, 1}, {1, 2}, {2, 3}, {3, 0}, {0, 2}, {2, 0}, {1, 1}, {5, 6}};
  const Wireframe<TestType> w(p, e);
  CHECK(w.vertex_count() == 7);
  CHECK(w.edge_count() == 8);
  const WireframeSummary& s = w.summary();
  CHECK(s.vertices == 7);
  CHECK(s.edges == 8);
  CHECK(s.components == 2);
  CHECK(s.unreferenced_vertices == 1);
  CHECK(s.zero_length_edges == 2);
  CHECK(s.loops == 1);
  CHECK(s.mean_edge == Approx((4 * 3 + 2 * std::sqrt(18.)) / 8));
  CHECK(w.unit() == 2);  // the power of two next to 2.56
  CHECK(w.bytes() > 8 * 12);
}

TEMPLATE_TEST_CASE("edges keep the caller's numbers, direction and length", "", float, double) {
  for (const unsigned seed : {1u, 2u, 3u}) {
    const Wires wires = random_wires(seed, 60, 90);
    const auto w = wires.wireframe<TestType>();
    for (Index e = 0; e < wires.edges.size(); ++e) {
      const auto ends = w.inside_edge(e);
      CHECK(ends.from == w.inside_vertex(wires.edges[e][0]));
      CHECK(ends.to == w.inside_vertex(wires.edges[e][1]));
      CHECK(double(ends.length) * w.unit() == double(static_cast<TestType>(wires.lengths[e])));
    }
    // Every arc is there from both ends, a loop once.
    std::size_t loops = 0;
    for (const auto& [a, b] : wires.edges) loops += a == b;
    CHECK(w.arcs().size() == 2 * wires.edges.size() - loops);
    CHECK(w.begin().back() == w.arcs().size());
  }
}

TEST_CASE("vertices that are near each other are near each other inside") {
  Positions p;
  Edges e;
  const Index n = 64;
  const auto at = [](Index i, Index j) { return (i * 37 % n) * n + j * 23 % n; };  // shuffled
  p.resize(n * n);
  for (Index i = 0; i < n; ++i)
    for (Index j = 0; j < n; ++j) {
      p[at(i, j)] = {double(i), double(j), 0};
      if (i > 0) e.push_back({at(i, j), at(i - 1, j)});
      if (j > 0) e.push_back({at(i, j), at(i, j - 1)});
    }
  const auto apart = [&](const Wireframe<float>& w) {
    double sum = 0;
    for (const auto& [a, b] : e)
      sum += std::abs(double(w.inside_vertex(a)) - double(w.inside_vertex(b)));
    return sum / double(e.size());
  };
  double given = 0;
  for (const auto& [a, b] : e) given += std::abs(double(a) - double(b)) / double(e.size());
  CHECK(apart(Wireframe<float>(p, e)) < 0.1 * given);
  CHECK(apart(Wireframe<float>(p.size(), e, Lengths(e.size(), 1))) < 0.1 * given);
}

TEST_CASE("bad wireframes are refused, and the edge is named") {
  const Positions p = {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}};
  CHECK(complaint(p, Edges{}) == "no complaint");
  CHECK(complaint(p, Edges{{0, 1}, {1, 3}}) == "edge 1: vertex 3 is out of range, there are 3");
  CHECK(complaint(p, Edges{{0, 1}, {none, 1}}) ==
        "edge 1: vertex 4294967295 is out of range, there are 3");
  for (const double bad : {no_number, inf, -inf})
    CHECK(complaint(Positions{{0, 0, 0}, {1, bad, 0}}, Edges{{0, 1}}) ==
          "vertex 1: a coordinate is not finite");
  CHECK(complaint(Positions{{-1.7e308, 0, 0}, {1.7e308, 0, 0}}, Edges{{0, 1}}) ==
        "edge 0: too long for a number");
  const std::size_t n = 3;
  CHECK(complaint(n, Edges{{0, 1}}, Lengths{}) == "1 edges with 0 lengths");
  for (const double bad : {no_number, inf, -1.})
    CHECK(complaint(n, Edges{{0, 1}, {1, 2}}, Lengths{1, bad}) ==
          "edge 1: its length is negative or not finite");
  CHECK(complaint(n, Edges{{0, 3}}, Lengths{1}) == "edge 0: vertex 3 is out of range, there are 3");
}

TEMPLATE_TEST_CASE("the ends of what a number can hold", "", float, double) {
  for (const double scale : {1e-320, 1e-300, 1e-30, 1e30, 1e300, 1.7e308}) {
    const Wireframe<TestType> w(3, Edges{{0, 1}, {1, 2}}, Lengths{scale, scale / 4});
    CHECK(std::isfinite(w.unit()));
    CHECK(w.unit() > 0);
    CHECK(double(w.inside_edge(0).length) * w.unit() == Approx(scale).epsilon(1e-6));
  }
  const Wireframe<TestType> points(3, Edges{{0, 1}, {1, 2}}, Lengths{0, 0});
  CHECK(points.unit() == 1);
  CHECK(points.summary().zero_length_edges == 2);
  CHECK(points.summary().components == 1);
}

TEST_CASE("vertices of lengths alone are numbered in blocks that lie together") {
  // A grid whose vertices come in any order, and components that are smaller than a block.
  constexpr Index n = 80;
  std::mt19937 random(3);
  std::vector<Index> place(std::size_t{n} * n + 20);
  for (std::size_t v = 0; v < place.size(); ++v) place[v] = static_cast<Index>(v);
  std::shuffle(place.begin(), place.end(), random);
  Edges edges;
  for (Index v = 0; v < n * n; ++v) {
    if (v % n > 0) edges.push_back({place[v - 1], place[v]});
    if (v >= n) edges.push_back({place[v], place[v - n]});
  }
  for (Index v = n * n; v + 1 < place.size(); v += 2) edges.push_back({place[v], place[v + 1]});
  for (const std::size_t block : {1u, 100u, 400u, 100000u}) {
    const auto order = vertices_in_blocks(place.size(), edges, block);
    REQUIRE(order.size() == place.size());
    std::vector<Index> at(order.size(), none);
    for (std::size_t i = 0; i < order.size(); ++i) at[order[i]] = static_cast<Index>(i);
    CHECK(std::find(at.begin(), at.end(), none) == at.end());
    std::size_t cut = 0;
    for (const auto& [a, b] : edges) cut += at[a] / block != at[b] / block;
    INFO("blocks of " << block << " cut " << cut << " of " << edges.size() << " edges");
    // Squares of that size would cut two edges for each row of theirs.
    if (block == 100 || block == 400)
      CHECK(static_cast<double>(cut) < 1.75 * 2 * n * n / std::sqrt(static_cast<double>(block)));
    if (block > place.size()) CHECK(cut == 0);
  }
}

}  // namespace plexway::testing::wireframe_test
