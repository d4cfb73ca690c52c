#include <plexway/wireframe/wireframe.hpp>

#include <catch2/catch.hpp>
#include <cmath>
#include <limits>

#include <plexway/error.hpp>

#include "complexes/test_wires.hpp"
#include "message_of.hpp"

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
  return message_of([&] { Wireframe<float> wireframe(arguments...); });
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

TEST_CASE("bad wireframes are refused, and the edge is named") {
  const Positions p = {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}};
  CHECK(complaint(p, Edges{}) == "");
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

}  // namespace plexway::testing::wireframe_test
