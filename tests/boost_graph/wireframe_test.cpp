#include <plexway/boost_graph/wireframe.hpp>

#include <boost/graph/adjacency_list.hpp>
#include <boost/graph/compressed_sparse_row_graph.hpp>
#include <boost/graph/dijkstra_shortest_paths.hpp>
#include <boost/property_map/function_property_map.hpp>
#include <catch2/catch.hpp>

#include <plexway/error.hpp>
#include <plexway/solve.hpp>

#include "complexes/test_wires.hpp"

namespace plexway::testing::wireframe_test {

using boost_graph::make_wireframe;

namespace {

template <class Real>
using Undirected =
    boost::adjacency_list<boost::vecS, boost::vecS, boost::undirectedS, boost::no_property,
                          boost::property<boost::edge_weight_t, Real>>;

template <class Real>
Undirected<Real> graph_of(const Wires& wires) {
  Undirected<Real> graph(wires.vertices);
  for (std::size_t e = 0; e < wires.edges.size(); ++e)
    add_edge(wires.edges[e][0], wires.edges[e][1], static_cast<Real>(wires.lengths[e]), graph);
  return graph;
}

template <class Real>
std::vector<Real> dijkstra(const Undirected<Real>& graph, Index source) {
  std::vector<Real> distance(num_vertices(graph));
  boost::dijkstra_shortest_paths(
      graph, source,
      boost::distance_map(
          boost::make_iterator_property_map(distance.begin(), get(boost::vertex_index, graph)))
          .distance_inf(std::numeric_limits<Real>::infinity()));
  return distance;
}

}  // namespace

TEMPLATE_TEST_CASE("wireframes of fifty graphs: the distances of Boost's Dijkstra", "", float,
                   double) {
  for (unsigned seed = 0; seed < 50; ++seed) {
    const double spread = seed % 4 == 0 ? 6 : seed % 4 == 1 ? 0 : 1;
    const Wires wires = random_wires(100 + seed, 30 + 20 * seed, 20 + 35 * seed, spread);
    const auto graph = graph_of<TestType>(wires);
    const auto w = make_wireframe<TestType>(graph, get(boost::edge_weight, graph));
    const Index source = 7 * seed % Index(wires.vertices);
    const auto exact = dijkstra(graph, source);
    const auto field = solve(Serial{}, w, PointSource::at(source));
    CAPTURE(seed);
    // More than asked: both take the least over paths of the same rounded sums.
    REQUIRE(field.distance == exact);
  }
}

TEST_CASE("a directed graph's edges are taken both ways") {
  struct Street {
    float metres;
  };
  using Csr = boost::compressed_sparse_row_graph<boost::directedS, boost::no_property, Street>;
  const std::vector<std::pair<int, int>> edges = {{0, 1}, {1, 0}, {2, 1}, {2, 3}};
  const std::vector<Street> streets = {{5}, {4}, {2}, {1}};
  const Csr graph(boost::edges_are_sorted, edges.begin(), edges.end(), streets.begin(), 5);
  const auto w = make_wireframe(graph, get(&Street::metres, graph));
  STATIC_REQUIRE(std::is_same_v<decltype(w), const Wireframe<float>>);
  CHECK(w.edge_count() == 4);
  CHECK(w.summary().components == 1);
  const auto field = solve(Serial{}, w, PointSource::at(0));
  const float inf = std::numeric_limits<float>::infinity();
  CHECK(field.distance == std::vector<float>{0, 4, 6, 7, inf});
}

TEST_CASE("any vertices, with an index map, and lengths from a function") {
  using Graph = boost::adjacency_list<boost::listS, boost::listS, boost::undirectedS,
                                      boost::property<boost::vertex_index_t, std::size_t>>;
  Graph graph;
  std::vector<Graph::vertex_descriptor> v;
  for (std::size_t i = 0; i < 4; ++i) v.push_back(add_vertex(3 - i, graph));  // numbered backwards
  add_edge(v[0], v[1], graph);
  add_edge(v[1], v[2], graph);
  const auto index = get(boost::vertex_index, graph);
  const auto length = [&](const Graph::edge_descriptor& e) {
    return 10. * double(get(index, source(e, graph)) + get(index, target(e, graph)));
  };
  const auto w = make_wireframe<double>(graph, length, index);
  const double inf = std::numeric_limits<double>::infinity();
  CHECK(solve(Serial{}, w, PointSource::at(3)).distance == std::vector<double>{inf, 80, 50, 0});
}

TEST_CASE("a graph that is no wireframe is refused, and the edge is named") {
  Wires wires = random_wires(2, 20, 30);
  wires.lengths[12] = -1;
  const auto graph = graph_of<double>(wires);
  CHECK_THROWS_WITH(make_wireframe(graph, get(boost::edge_weight, graph)),
                    "edge 12: its length is negative or not finite");
  const auto out =
      boost::make_function_property_map<std::size_t>([](std::size_t v) { return v + 9; });
  CHECK_THROWS_AS(make_wireframe(graph, get(boost::edge_weight, graph), out), InputError);
  const Undirected<double> empty(3);
  const auto points = make_wireframe(empty, get(boost::edge_weight, empty));  // is one, of points
  CHECK(points.vertex_count() == 3);
  CHECK(points.edge_count() == 0);
}

}  // namespace plexway::testing::wireframe_test
