#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include <plexway/common/detail/storage.hpp>
#include <plexway/common/ids.hpp>
#include <plexway/common/rows_of.hpp>
#include <plexway/domain/concept.hpp>

namespace plexway {

namespace detail {
struct KeptParts;
}  // namespace detail

/// The counts of a wireframe, made while it is built.
struct WireframeSummary {
  /// In an edge or not: as many as were given.
  std::size_t vertices = 0;
  /// As given, parallel edges and loops included.
  std::size_t edges = 0;
  std::size_t components = 0;             ///< of edges joined at vertices
  std::size_t unreferenced_vertices = 0;  ///< in no edge: unreachable
  /// Of length 0.
  std::size_t zero_length_edges = 0;
  double mean_edge = 0;   ///< in the input's unit
  std::size_t loops = 0;  ///< edges from a vertex to itself: allowed, but no path gains by one
};

/// An edge as its vertex has it: where it leads, and its length in the unit inside.
template <class Real>
struct WireArc {
  /// The vertex it leads to, inside.
  Index to;
  /// In the unit inside.
  Real length;
};

/// Edges that meet in vertices, each with a length: a graph, a lattice of struts, a tree of
/// vessels.
///
/// Edges are the simplices and vertices the hinges. Several edges between the same two vertices,
/// loops, edges without length, several components and unreferenced vertices are all allowed.
/// Immutable once built, so any number of threads may read it.
///
/// Vertices and edges have the caller's numbers in this interface. Inside, vertices are sorted for
/// locality. Memory in float: 8 bytes a vertex and 20 an edge.
template <class Real>
class Wireframe {
  static_assert(is_number_of_domains<Real>, "distances are float or double");

 public:
  /// The precision of lengths inside, and of fields.
  using Number = Real;
  /// A wireframe.
  static constexpr DomainKind kind = DomainKind::wireframe;
  /// Of its simplices.
  static constexpr int dimension = 1;

  /// From n positions in any unit and m edges of vertex indices < n. Throws InputError naming the
  /// edge for an index out of range or a length too large for a double, the vertex for a coordinate
  /// that is not finite, and for more than 2^31 - 1 edges. Cost: n log n, about 0.2 us a
  /// vertex.
  Wireframe(const GivenPoints& positions, const GivenSimplices<2>& edges);

  /// From one length an edge. Throws as above, and for a length that is negative or not finite.
  Wireframe(std::size_t vertices, const GivenSimplices<2>& edges, const Given<double>& lengths);

  /// n, in an edge or not: fields have one distance each.
  [[nodiscard]] std::size_t vertex_count() const { return vertex_to_inside_.size(); }
  /// m.
  [[nodiscard]] std::size_t edge_count() const { return arc_of_edge_.size(); }
  /// The same: edges are a wireframe's simplices.
  [[nodiscard]] std::size_t simplex_count() const { return edge_count(); }
  /// Intrinsic: the lengths of edges are all that counts.
  [[nodiscard]] MetricKind metric() const { return MetricKind::intrinsic; }
  /// Its counts, made while it was built.
  [[nodiscard]] const WireframeSummary& summary() const { return summary_; }
  /// Bytes this complex holds.
  [[nodiscard]] std::size_t bytes() const;
  /// One unit inside, in the input's unit: the power of two next to the mean edge length, so that
  /// changing units costs no digit.
  [[nodiscard]] double unit() const { return unit_; }

  /// What a dual queue should count as the length of an edge, in the unit inside: the mean m,
  /// unless lengths are of very different size. The median d then says more, and less of it is
  /// better: d (1 + d / m) / 2, edges without length left out. > 0.
  [[nodiscard]] double typical_edge() const { return typical_edge_; }

  // What follows serves the layers above and uses the numbers inside.
  /// @name For the layers above
  ///@{

  /// The arcs of vertex v are those from begin()[v] to begin()[v + 1]. A loop is there once.
  [[nodiscard]] std::span<const Index> begin() const { return begin_; }
  /// All arcs, vertex by vertex: each edge from both its ends.
  [[nodiscard]] std::span<const WireArc<Real>> arcs() const { return arcs_; }
  /// The number inside of a vertex, which must be one (not checked).
  [[nodiscard]] Index inside_vertex(Index vertex) const { return vertex_to_inside_[vertex]; }
  /// The number inside of each vertex, in the caller's order.
  [[nodiscard]] std::span<const Index> vertices_inside() const { return vertex_to_inside_; }

  /// An edge in the caller's direction.
  struct Ends {
    ///@{
    /// Vertices, inside.
    Index from, to;
    ///@}
    /// In the unit inside.
    Real length;
  };
  /// Cost: logarithmic.
  [[nodiscard]] Ends inside_edge(Index edge) const;
  /// Of the content: a copy has the same, everything else another (Identity).
  [[nodiscard]] std::uint64_t identity() const { return identity_.value(); }
  ///@}

 private:
  friend struct detail::KeptParts;
  Wireframe() = default;

  void assemble(std::span<const std::array<Index, 2>> edges, std::span<const double> lengths);
  void count_components();

  WireframeSummary summary_;
  detail::Identity identity_;
  double unit_ = 1, typical_edge_ = 1;
  detail::Rows<Index> begin_;
  detail::Rows<WireArc<Real>> arcs_;
  detail::Rows<Index> vertex_to_inside_;
  detail::Rows<Index> arc_of_edge_;  // from the edge's first vertex to its second
};

/// Of the numbers that the points are: float, or double.
template <detail::AnyRows Points, detail::AnyRows Edges>
Wireframe(const Points&, const Edges&) -> Wireframe<detail::NumberOf<Points>>;

extern template class Wireframe<float>;
extern template class Wireframe<double>;

}  // namespace plexway
