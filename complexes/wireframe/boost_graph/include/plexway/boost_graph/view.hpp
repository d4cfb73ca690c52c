#pragma once

// A complex as Boost.Graph sees it. The one header of this provider that includes Boost, for
// programs that call Boost's algorithms themselves; nothing else of plexway includes it.

#include <boost/graph/graph_traits.hpp>
#include <boost/graph/properties.hpp>
#include <boost/iterator/counting_iterator.hpp>
#include <boost/iterator/transform_iterator.hpp>
#include <boost/property_map/property_map.hpp>
#include <cstddef>
#include <utility>

#include <plexway/boost_graph/edge_graph.hpp>

namespace plexway::boost_graph {

/// An EdgeGraph as a model of Boost's VertexListGraph, EdgeListGraph, IncidenceGraph and
/// AdjacencyGraph: undirected, with parallel edges. Its vertex descriptors are the caller's
/// numbers, and it has the property maps vertex_index, edge_index and edge_weight (the lengths), so
/// that Boost's algorithms take it without further arguments:
///
///     const EdgeGraph graph(mesh);
///     boost::dijkstra_shortest_paths(GraphView(graph), 0, boost::distance_map(distance.data()));
///
/// Owns nothing: the EdgeGraph must outlive it, and copies are free. A loop is one out-edge of its
/// vertex.
class GraphView {
 public:
  /// Of a graph that outlives it.
  explicit GraphView(const EdgeGraph& graph) : graph_(&graph) {}
  /// The graph it shows.
  [[nodiscard]] const EdgeGraph& graph() const { return *graph_; }

  // What boost::graph_traits asks a graph for.
  /// Vertices go by the caller's numbers.
  using vertex_descriptor = Index;
  /// An edge as it is walked: from one vertex to another, with the edge's number.
  struct edge_descriptor {
    ///@{
    /// none in one that stands for no edge.
    Index from = none, to = none, edge = none;
    ///@}
    /// From either end it is the same edge.
    friend bool operator==(const edge_descriptor& a, const edge_descriptor& b) {
      return a.edge == b.edge;
    }
    /// By number.
    friend bool operator<(const edge_descriptor& a, const edge_descriptor& b) {
      return a.edge < b.edge;
    }
  };
  /// Edges are walked both ways.
  using directed_category = boost::undirected_tag;
  /// Two vertices may have several edges.
  using edge_parallel_category = boost::allow_parallel_edge_tag;
  /// Which of Boost's concepts it is a model of.
  struct traversal_category : virtual boost::incidence_graph_tag,
                              virtual boost::adjacency_graph_tag,
                              virtual boost::vertex_list_graph_tag,
                              virtual boost::edge_list_graph_tag {};
  /// Counts vertices.
  using vertices_size_type = std::size_t;
  /// Counts edges.
  using edges_size_type = std::size_t;
  /// Counts the edges at a vertex.
  using degree_size_type = std::size_t;
  /// Stands for no vertex.
  static vertex_descriptor null_vertex() { return none; }

  /// Makes an edge of an arc of a vertex.
  struct OutEdge {
    /// The graph it is of.
    const EdgeGraph* graph = nullptr;
    /// The vertex whose arcs they are.
    Index from = none;
    /// The edge of an arc.
    edge_descriptor operator()(Index arc) const {
      return {from, graph->arcs()[arc].to, graph->arcs()[arc].edge};
    }
  };
  /// Makes a vertex of an arc: where it leads.
  struct Neighbour {
    /// The graph it is of.
    const EdgeGraph* graph = nullptr;
    /// The vertex at an arc's end.
    vertex_descriptor operator()(Index arc) const { return graph->arcs()[arc].to; }
  };
  /// Makes an edge of its number, in the complex's direction.
  struct Edge {
    /// The graph it is of.
    const EdgeGraph* graph = nullptr;
    /// Edge e.
    edge_descriptor operator()(Index e) const {
      return {graph->edges()[e][0], graph->edges()[e][1], e};
    }
  };
  /// Over all vertices.
  using vertex_iterator = boost::counting_iterator<Index>;
  /// Over the edges at a vertex.
  using out_edge_iterator = boost::transform_iterator<OutEdge, boost::counting_iterator<Index>>;
  /// Over the neighbours of a vertex.
  using adjacency_iterator = boost::transform_iterator<Neighbour, boost::counting_iterator<Index>>;
  /// Over all edges.
  using edge_iterator = boost::transform_iterator<Edge, boost::counting_iterator<Index>>;

  /// The lengths, in the complex's unit.
  struct LengthMap {
    /// Asked for an edge ...
    using key_type = edge_descriptor;
    /// ... it gives a length
    using value_type = double;
    /// by value.
    using reference = double;
    /// It can be read only.
    using category = boost::readable_property_map_tag;
    /// The graph it is of.
    const EdgeGraph* graph = nullptr;
    /// The length of an edge.
    friend double get(const LengthMap& map, const edge_descriptor& e) {
      return map.graph->lengths()[e.edge];
    }
  };
  /// The numbers of edges.
  struct EdgeIndexMap {
    /// Asked for an edge ...
    using key_type = edge_descriptor;
    /// ... it gives a number
    using value_type = Index;
    /// by value.
    using reference = Index;
    /// It can be read only.
    using category = boost::readable_property_map_tag;
    /// The number of an edge.
    friend Index get(const EdgeIndexMap&, const edge_descriptor& e) { return e.edge; }
  };
  /// The numbers of vertices: themselves.
  using VertexIndexMap = boost::typed_identity_property_map<Index>;

 private:
  const EdgeGraph* graph_;
};

///@{
/// What Boost's concepts and property maps ask of a graph, as Boost documents it. Cost: constant.
inline std::size_t num_vertices(const GraphView& g) { return g.graph().vertex_count(); }
inline std::size_t num_edges(const GraphView& g) { return g.graph().edges().size(); }

inline std::pair<GraphView::vertex_iterator, GraphView::vertex_iterator> vertices(
    const GraphView& g) {
  return {GraphView::vertex_iterator(0),
          GraphView::vertex_iterator(static_cast<Index>(num_vertices(g)))};
}

inline std::pair<GraphView::edge_iterator, GraphView::edge_iterator> edges(const GraphView& g) {
  const auto at = [&](std::size_t e) {
    return GraphView::edge_iterator(boost::counting_iterator<Index>(static_cast<Index>(e)),
                                    GraphView::Edge{&g.graph()});
  };
  return {at(0), at(num_edges(g))};
}

inline Index vertex(std::size_t n, const GraphView&) { return static_cast<Index>(n); }
inline Index source(const GraphView::edge_descriptor& e, const GraphView&) { return e.from; }
inline Index target(const GraphView::edge_descriptor& e, const GraphView&) { return e.to; }

inline std::size_t out_degree(Index v, const GraphView& g) {
  return g.graph().begin()[v + 1] - g.graph().begin()[v];
}

inline std::pair<GraphView::out_edge_iterator, GraphView::out_edge_iterator> out_edges(
    Index v, const GraphView& g) {
  const auto at = [&](Index arc) {
    return GraphView::out_edge_iterator(boost::counting_iterator<Index>(arc),
                                        GraphView::OutEdge{&g.graph(), v});
  };
  return {at(g.graph().begin()[v]), at(g.graph().begin()[v + 1])};
}

inline std::pair<GraphView::adjacency_iterator, GraphView::adjacency_iterator> adjacent_vertices(
    Index v, const GraphView& g) {
  const auto at = [&](Index arc) {
    return GraphView::adjacency_iterator(boost::counting_iterator<Index>(arc),
                                         GraphView::Neighbour{&g.graph()});
  };
  return {at(g.graph().begin()[v]), at(g.graph().begin()[v + 1])};
}

inline GraphView::VertexIndexMap get(boost::vertex_index_t, const GraphView&) { return {}; }
inline Index get(boost::vertex_index_t, const GraphView&, Index v) { return v; }
inline GraphView::EdgeIndexMap get(boost::edge_index_t, const GraphView&) { return {}; }
inline Index get(boost::edge_index_t, const GraphView&, const GraphView::edge_descriptor& e) {
  return e.edge;
}
inline GraphView::LengthMap get(boost::edge_weight_t, const GraphView& g) { return {&g.graph()}; }
inline double get(boost::edge_weight_t, const GraphView& g, const GraphView::edge_descriptor& e) {
  return g.graph().lengths()[e.edge];
}
///@}

}  // namespace plexway::boost_graph

namespace boost {

template <>
struct property_map<plexway::boost_graph::GraphView, vertex_index_t> {
  using type = plexway::boost_graph::GraphView::VertexIndexMap;
  using const_type = type;
};
template <>
struct property_map<plexway::boost_graph::GraphView, edge_index_t> {
  using type = plexway::boost_graph::GraphView::EdgeIndexMap;
  using const_type = type;
};
template <>
struct property_map<plexway::boost_graph::GraphView, edge_weight_t> {
  using type = plexway::boost_graph::GraphView::LengthMap;
  using const_type = type;
};

}  // namespace boost
