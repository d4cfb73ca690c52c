#pragma once

#include <array>
#include <cstddef>
#include <memory>
#include <span>

#include <plexway/boost_graph/edge_graph.hpp>
#include <plexway/common/ids.hpp>

namespace plexway::boost_graph {

/// Shortest paths along the edges of a surface or of any complex by Boost.Graph's Dijkstra on a
/// compressed sparse row graph.
///
/// On a wireframe that is the geodesic distance; on others an upper bound of it, some per cent
/// above however fine the mesh. The peer that propagation is measured against. Two vertices are
/// joined once, whatever the number of triangles on their edge; a face that names a vertex twice
/// adds no loop.
template <class Real>
class EdgeDijkstra {
 public:
  /// From n positions in any unit and m triangles of vertex indices < n. Throws InputError naming
  /// the face for an index out of range or an edge whose length Real cannot hold, and for more
  /// than 2^32 - 1 directed edges. Cost: linear.
  EdgeDijkstra(std::span<const std::array<double, 3>> positions,
               std::span<const std::array<Index, 3>> faces);
  /// Along the edges of a graph, which is copied. Throws InputError for a length that Real cannot
  /// hold. Cost: linear.
  explicit EdgeDijkstra(const EdgeGraph& graph);
  ~EdgeDijkstra();
  /// Moves what it holds; what is left may be assigned to or destroyed, no more.
  EdgeDijkstra(EdgeDijkstra&&) noexcept;
  /// Likewise.
  EdgeDijkstra& operator=(EdgeDijkstra&&) noexcept;
  EdgeDijkstra(const EdgeDijkstra&) = delete;
  EdgeDijkstra& operator=(const EdgeDijkstra&) = delete;

  /// Distances from one vertex by the call that Boost documents: dijkstra_shortest_paths with its
  /// own 4-ary heap and defaults. Throws UsageError for a vertex that is not there. Cost:
  /// O(n log n), 70 to 200 ns a vertex.
  void run(Index source);
  /// The same by the fastest of Boost's variants (no colour map, no initialisation of its own):
  /// 10 to 20 % less time.
  void run_without_colours(Index source);
  /// What the last run found: one a vertex in the caller's order, +inf where unreached (or before
  /// the first run).
  [[nodiscard]] std::span<const Real> distance() const;
  /// Bytes held between runs. A run takes 8 a vertex more, and the heap.
  [[nodiscard]] std::size_t bytes() const;

 private:
  void check_source(Index source) const;

  struct State;
  std::unique_ptr<State> state_;
};

extern template class EdgeDijkstra<float>;
extern template class EdgeDijkstra<double>;

}  // namespace plexway::boost_graph
