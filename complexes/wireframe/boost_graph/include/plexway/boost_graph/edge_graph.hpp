#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include <plexway/common/ids.hpp>
#include <plexway/solid/tet_mesh.hpp>
#include <plexway/surface/triangle_mesh.hpp>
#include <plexway/wireframe/wireframe.hpp>

/// The component `boost_graph`, link plexway::boost_graph: Boost's graphs, and its Dijkstra.
namespace plexway::boost_graph {

/// The vertices and edges of a complex with their lengths, ready to be walked in the caller's
/// numbers. `view.hpp` shows it to Boost.Graph. Immutable; 4 bytes a vertex and 32 an edge.
class EdgeGraph {
 public:
  /// n vertices and m edges with a length each; parallel edges and loops are kept. Throws
  /// InputError naming the edge for an index >= n or a length that is negative or not finite, and
  /// for more than 2^31 - 1 edges. Cost: linear.
  EdgeGraph(std::size_t vertices, std::span<const std::array<Index, 2>> edges,
            std::span<const double> lengths);

  /// Of a complex, with the caller's vertices. Edges of a wireframe have the caller's numbers,
  /// those of a surface or a solid an order of its own, each once whatever the number of simplices
  /// on it.
  /// Cost: linear, but for sorting the edges of a surface or a solid.
  template <class Real>
  explicit EdgeGraph(const Wireframe<Real>& wireframe);
  /// Of a surface: the sides of its triangles.
  template <class Real>
  explicit EdgeGraph(const TriangleMesh<Real>& mesh);
  /// Of a solid: the edges of its tetrahedra.
  template <class Real>
  explicit EdgeGraph(const TetMesh<Real>& mesh);

  /// An edge as a vertex has it.
  struct Arc {
    ///@{
    /// The vertex it leads to, and the number of the edge.
    Index to, edge;
    ///@}
  };

  /// n.
  [[nodiscard]] std::size_t vertex_count() const { return begin_.size() - 1; }
  /// The two vertices of each edge.
  [[nodiscard]] std::span<const std::array<Index, 2>> edges() const { return edges_; }
  /// Of each edge, in the complex's unit.
  [[nodiscard]] std::span<const double> lengths() const { return lengths_; }
  /// The arcs of vertex v are those from begin()[v] to begin()[v + 1]. A loop is there once.
  [[nodiscard]] std::span<const Index> begin() const { return begin_; }
  /// All arcs, vertex by vertex: each edge from both its ends.
  [[nodiscard]] std::span<const Arc> arcs() const { return arcs_; }

 private:
  void assemble(std::size_t vertices);

  std::vector<std::array<Index, 2>> edges_;
  std::vector<double> lengths_;
  std::vector<Index> begin_;
  std::vector<Arc> arcs_;
};

}  // namespace plexway::boost_graph
