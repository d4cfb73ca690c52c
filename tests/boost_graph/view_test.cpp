#include <boost/graph/adjacency_list.hpp>
#include <boost/graph/astar_search.hpp>
#include <boost/graph/breadth_first_search.hpp>
#include <boost/graph/compressed_sparse_row_graph.hpp>
#include <boost/graph/connected_components.hpp>
#include <boost/graph/dijkstra_shortest_paths.hpp>
#include <boost/graph/graph_concepts.hpp>
#include <boost/graph/kruskal_min_spanning_tree.hpp>
#include <boost/property_map/function_property_map.hpp>
#include <catch2/catch.hpp>

#include <plexway/boost_graph/view.hpp>
#include <plexway/boost_graph/wireframe.hpp>
#include <plexway/error.hpp>
#include <plexway/solve.hpp>

#include "complexes/test_wires.hpp"

namespace plexway::testing::view_test {

using boost_graph::EdgeGraph;
using boost_graph::GraphView;

BOOST_CONCEPT_ASSERT((boost::VertexListGraphConcept<GraphView>));
BOOST_CONCEPT_ASSERT((boost::EdgeListGraphConcept<GraphView>));
BOOST_CONCEPT_ASSERT((boost::IncidenceGraphConcept<GraphView>));
BOOST_CONCEPT_ASSERT((boost::AdjacencyGraphConcept<GraphView>));

namespace {

constexpr double inf = std::numeric_limits<double>::infinity();

std::vector<double> dijkstra(const EdgeGraph& graph, Index source) {
  std::vector<double> distance(graph.vertex_count());
  boost::dijkstra_shortest_paths(
      GraphView(graph), source,
      boost::distance_map(boost::make_iterator_property_map(
                              distance.data(), boost::typed_identity_property_map<Index>()))
          .distance_inf(inf));
  return distance;
}

void check_close(const std::vector<double>& found, const std::vector<double>& exact,
                 double tolerance) {
  REQUIRE(found.size() == exact.size());
  for (std::size_t v = 0; v < exact.size(); ++v) {
    CAPTURE(v, found[v], exact[v]);
    REQUIRE((found[v] == exact[v] || std::abs(found[v] - exact[v]) <= tolerance * exact[v]));
  }
}

struct Found {};

// Stops a search at the goal and counts what it looked at.
struct GoalVisitor : boost::default_astar_visitor {
  Index goal;
  std::size_t* examined;
  GoalVisitor(Index g, std::size_t* n) : goal(g), examined(n) {}
  void examine_vertex(Index v, const GraphView&) {
    ++*examined;
    if (v == goal) throw Found{};
  }
};

}  // namespace

TEST_CASE("view: the caller's edges, from both ends") {
  const Wires wires = random_wires(4, 30, 50);
  const EdgeGraph graph(wires.vertices, wires.edges, wires.lengths);
  const GraphView view(graph);
  CHECK(num_vertices(view) == 30);
  CHECK(num_edges(view) == wires.edges.size());
  std::size_t e = 0;
  for (auto [it, end] = edges(view); it != end; ++it, ++e) {
    CHECK(source(*it, view) == wires.edges[e][0]);
    CHECK(target(*it, view) == wires.edges[e][1]);
    CHECK(get(boost::edge_index, view, *it) == e);
    CHECK(get(get(boost::edge_weight, view), *it) == wires.lengths[e]);
  }
  CHECK(e == wires.edges.size());
  std::vector<int> seen(wires.edges.size(), 0);
  for (auto [v, last] = vertices(view); v != last; ++v) {
    auto [near, near_end] = adjacent_vertices(*v, view);
    CHECK(std::size_t(near_end - near) == out_degree(*v, view));
    for (auto [out, end] = out_edges(*v, view); out != end; ++out, ++near) {
      CHECK(source(*out, view) == *v);
      CHECK(target(*out, view) == *near);
      const Index number = get(boost::edge_index, view, *out);
      const auto [a, b] = wires.edges[number];
      CHECK(((a == *v && b == *near) || (b == *v && a == *near)));
      ++seen[number];
    }
  }
  for (std::size_t i = 0; i < seen.size(); ++i)
    CHECK(seen[i] == (wires.edges[i][0] == wires.edges[i][1] ? 1 : 2));
}

TEMPLATE_TEST_CASE("view: Boost's Dijkstra on a wireframe", "", float, double) {
  for (const unsigned seed : {1u, 2u, 3u}) {
    const Wires wires = random_wires(seed, 100, 160);
    const EdgeGraph graph(wires.wireframe<TestType>());
    for (std::size_t e = 0; e < wires.edges.size(); ++e) CHECK(graph.edges()[e] == wires.edges[e]);
    check_close(dijkstra(graph, 5), edge_distances(wires, 5), 1e-6);
  }
}

TEMPLATE_TEST_CASE("view: a surface's edges, each once", "", float, double) {
  for (const Surface& s : {grid(7, 5), sphere(2), moebius(12), sheets(3, 4), bow_tie(4)}) {
    const auto mesh = s.mesh<TestType>();
    const EdgeGraph graph(mesh);
    CHECK(graph.edges().size() == mesh.summary().edges);
    Wires wires{s.positions.size(), {}, {}};
    for (const Face& f : s.faces)
      for (std::size_t i = 0; i < 3; ++i) {
        const Position &a = s.positions[f[i]], &b = s.positions[f[(i + 1) % 3]];
        wires.add(f[i], f[(i + 1) % 3], std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]));
      }
    check_close(dijkstra(graph, 3), edge_distances(wires, 3), 1e-6);
  }
}

TEST_CASE("view: A star finds the same way and looks at less") {
  const Surface s = grid(60, 60);
  const EdgeGraph graph(s.mesh<double>());
  const Index from = s.nearest(.1, .1), goal = s.nearest(.6, .7);
  const auto run = [&](auto heuristic, std::size_t& examined) {
    std::vector<double> distance(graph.vertex_count());
    std::vector<Index> before(graph.vertex_count());
    const boost::typed_identity_property_map<Index> index;
    try {
      boost::astar_search(
          GraphView(graph), from, heuristic,
          boost::distance_map(boost::make_iterator_property_map(distance.data(), index))
              .predecessor_map(boost::make_iterator_property_map(before.data(), index))
              .visitor(GoalVisitor(goal, &examined)));
    } catch (const Found&) {
    }
    std::size_t steps = 0;
    for (Index v = goal; v != from && steps < before.size(); v = before[v]) ++steps;
    CHECK(steps < 100);
    return distance[goal];
  };
  struct StraightLine : boost::astar_heuristic<GraphView, double> {
    const Surface* s;
    Index goal;
    StraightLine(const Surface* surface, Index g) : s(surface), goal(g) {}
    double operator()(Index v) const {
      const Position &a = s->positions[v], &b = s->positions[goal];
      return std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]);
    }
  };
  std::size_t with = 0, without = 0;
  const double d = run(StraightLine(&s, goal), with);
  CHECK(d == Approx(run(boost::astar_heuristic<GraphView, double>(), without)));
  // Diagonals run up to the right: 30 of them and 6 steps up.
  CHECK(d == Approx((30 * std::sqrt(2.) + 6) / 60));
  CHECK(with < without / 2);
}

TEST_CASE("view: connected components agree with the summary") {
  for (unsigned seed = 0; seed < 20; ++seed) {
    const Wires wires = random_wires(seed, 200, 40 + 10 * seed);
    const auto w = wires.wireframe<float>();
    const EdgeGraph graph(w);
    std::vector<Index> of_vertex(wires.vertices);
    const std::size_t count = boost::connected_components(
        GraphView(graph), boost::make_iterator_property_map(
                              of_vertex.data(), boost::typed_identity_property_map<Index>()));
    CHECK(count == w.summary().components + w.summary().unreferenced_vertices);
  }
}

TEST_CASE("an edge graph of tetrahedra has each edge once, with its length") {
  const std::vector<std::array<double, 3>> at = {{0, 0, 0}, {1, 0, 0}, {0, 2, 0},
                                                 {0, 0, 3}, {1, 2, 3}, {9, 9, 9}};
  const std::vector<std::array<Index, 4>> tets = {{0, 1, 2, 3}, {4, 1, 2, 3}};
  const boost_graph::EdgeGraph graph(TetMesh<double>(at, tets));
  CHECK(graph.edges().size() == 9);
  for (std::size_t e = 0; e < graph.edges().size(); ++e) {
    const auto &p = at[graph.edges()[e][0]], &q = at[graph.edges()[e][1]];
    CHECK(graph.lengths()[e] == Approx(std::hypot(p[0] - q[0], p[1] - q[1], p[2] - q[2])));
  }
}

TEST_CASE("view: other algorithms run as they are") {
  const Wires wires = random_wires(6, 60, 100);
  const EdgeGraph graph(wires.vertices, wires.edges, wires.lengths);
  const GraphView view(graph);
  std::size_t reached = 0;
  struct Count : boost::default_bfs_visitor {
    std::size_t* n;
    explicit Count(std::size_t* counter) : n(counter) {}
    void discover_vertex(Index, const GraphView&) { ++*n; }
  };
  boost::breadth_first_search(view, 0u, boost::visitor(Count(&reached)));
  std::vector<Index> part(wires.vertices);
  const std::size_t parts = boost::connected_components(
      view,
      boost::make_iterator_property_map(part.data(), boost::typed_identity_property_map<Index>()));
  CHECK(reached == std::size_t(std::count(part.begin(), part.end(), 0u)));
  std::vector<GraphView::edge_descriptor> tree;
  boost::kruskal_minimum_spanning_tree(view, std::back_inserter(tree));
  CHECK(tree.size() == wires.vertices - parts);
}

TEST_CASE("an edge graph refuses what is none, and a view is a graph to make a wireframe from") {
  using Edges = std::vector<std::array<Index, 2>>;
  const auto refuse = [](std::size_t n, const Edges& e, const std::vector<double>& l) {
    CHECK_THROWS_AS(EdgeGraph(n, e, l), InputError);
  };
  refuse(2, {{0, 2}}, {1});
  refuse(2, {{0, 1}}, {});
  refuse(2, {{0, 1}}, {-1});
  refuse(2, {{0, 1}}, {inf});
  CHECK_NOTHROW(EdgeGraph(3, Edges{}, std::vector<double>{}));

  const Wires wires = random_wires(5, 40, 60);
  const EdgeGraph graph(wires.vertices, wires.edges, wires.lengths);
  const auto back = boost_graph::make_wireframe<double>(GraphView(graph),
                                                        get(boost::edge_weight, GraphView(graph)));
  const auto field = solve(Serial{}, back, PointSource::at(0));
  check_close(field.distance, edge_distances(wires, 0), 1e-14);
}

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

}  // namespace plexway::testing::view_test
