#pragma once

#include <array>
#include <cstddef>
#include <type_traits>
#include <vector>

#include <plexway/wireframe/wireframe.hpp>

namespace plexway::boost_graph {

/// A wireframe from any of Boost's graphs (a VertexListGraph and EdgeListGraph), or from any type
/// that speaks their language: edges(g), source(e, g), target(e, g), num_vertices(g).
///
/// `length` is a property map of the edges, read by get(length, e), or a function of an edge.
/// `index` is a property map from vertices to 0 ... n - 1, which become the wireframe's vertices.
/// The wireframe's edges are numbered in the order of edges(g).
///
/// A geodesic distance is the same there and back, so a directed edge is taken both ways. Where a
/// directed graph holds both directions of an edge, the wireframe has two parallel edges, and the
/// shorter one counts.
///
/// Throws as the wireframe does (InputError naming the edge): an index >= n, a length that is
/// negative or not finite, no edges. This header includes nothing of Boost.
template <class Real = float, class Graph, class LengthMap, class IndexMap>
[[nodiscard]] Wireframe<Real> make_wireframe(const Graph& graph, const LengthMap& length,
                                             const IndexMap& index) {
  const std::size_t n = static_cast<std::size_t>(num_vertices(graph));
  std::vector<std::array<Index, 2>> ends;
  std::vector<double> lengths;
  const auto number = [&](const auto& vertex) {
    const auto i = static_cast<std::size_t>(get(index, vertex));
    return i < n ? static_cast<Index>(i) : none;
  };
  auto [edge, last] = edges(graph);
  for (; edge != last; ++edge) {
    const auto e = *edge;
    ends.push_back({number(source(e, graph)), number(target(e, graph))});
    if constexpr (std::is_invocable_v<const LengthMap&, decltype(e)>)
      lengths.push_back(static_cast<double>(length(e)));
    else
      lengths.push_back(static_cast<double>(get(length, e)));
  }
  return Wireframe<Real>(n, ends, lengths);
}

/// The identity, for graphs whose vertex descriptors are the numbers 0 ... n - 1.
struct NumberedVertices {
  /// As a property map: every vertex is its own number.
  template <class Vertex>
  friend Vertex get(const NumberedVertices&, const Vertex& vertex) {
    static_assert(std::is_integral_v<Vertex>,
                  "this graph's vertices are no numbers: pass a vertex index map as well");
    return vertex;
  }
};

/// The same for graphs that number their vertices: adjacency_list over vecS,
/// compressed_sparse_row_graph, adjacency_matrix.
template <class Real = float, class Graph, class LengthMap>
[[nodiscard]] Wireframe<Real> make_wireframe(const Graph& graph, const LengthMap& length) {
  return make_wireframe<Real>(graph, length, NumberedVertices{});
}

}  // namespace plexway::boost_graph
