#pragma once

#include <array>
#include <cstddef>
#include <memory>
#include <span>
#include <vector>

#include <plexway/common/ids.hpp>
#include <plexway/common/rows_of.hpp>
#include <plexway/domain/concept.hpp>
#include <plexway/simplicial/detail/simplex_record.hpp>

namespace plexway {

template <class Real>
class TriangleMesh;
template <class Real>
class TetMesh;

namespace detail {

/// What is known of a complex of four dimensions where it is flat, for the library's own use.
template <int N>
struct FlatDomain;

template <int N>
struct FlatFormOf {
  using type = FlatDomain<N>;
};
template <>
struct FlatFormOf<2> {
  using type = TriangleMesh<double>;
};
template <>
struct FlatFormOf<3> {
  using type = TetMesh<double>;
};

}  // namespace detail

/// What a flat complex is solved as: the surface or the solid of the same vertices and simplices,
/// in the caller's order; in four dimensions points and the faces on which paths bend.
template <int N>
using FlatForm = typename detail::FlatFormOf<N>::type;

/// The counts of a complex, made while it is built.
struct SimplicialSummary {
  /// Referenced or not: as many as were given.
  std::size_t vertices = 0;
  /// Of dimension N.
  std::size_t simplices = 0;
  /// Of simplices, each once, however many simplices share it.
  std::size_t facets = 0;
  std::size_t boundary_facets = 0;        ///< one simplex
  std::size_t fan_facets = 0;             ///< more than two simplices
  std::size_t pinched_vertices = 0;       ///< parts that share no facet touch there
  std::size_t unreferenced_vertices = 0;  ///< in no simplex: unreachable
  std::size_t degenerate_simplices = 0;   ///< no volume
  std::size_t violated_simplices = 0;     ///< no flat simplex has these lengths
  std::size_t components = 0;             ///< of simplices joined by vertices
  bool flat = false;  ///< lies in N coordinates, N its dimension, and does not overlap itself
  std::size_t bending_faces = 0;  ///< if so: where paths around obstacles bend
  double mean_edge = 0;           ///< in the input's unit; the library works in this unit inside
};

/// A domain of dimension N = 1 to 4 as a metric space: N-simplices with edge lengths, glued where
/// all but one of their vertices are the same. N = 1 is a graph, N = 4 space-time or a
/// configuration space.
///
/// Boundary, several components, facets with more than two simplices, simplices that touch only in
/// a vertex or an edge (a path may then pass at their common vertices), unreferenced vertices and
/// simplices without volume are all allowed. Lengths that no flat simplex has are counted and
/// lived with: distances are then finite, and only as good as such lengths. Immutable once built.
///
/// Where vertices have coordinates it is found out whether the complex lies flat (summary().flat).
/// If it does, distances under Visibility::saddles, the default, are lengths of paths around
/// obstacles, never short by more than rounding: by the windows of a surface, by the strings of a
/// solid, in four dimensions by strings of their own, in double whatever Real is. Every other
/// policy, and a complex that is not flat, takes the plain step: exact where nothing is in the way.
///
/// Vertices and simplices have the caller's numbers in this interface; inside they are in
/// breadth-first order. Memory, float: 33, 53, 77 and 104 bytes a simplex for N = 1 to 4, and 8 a
/// vertex; a flat one has its surface or solid, too, or in four dimensions 32 bytes more of each,
/// another one with coordinates 8 for each of a vertex. A facet with n simplices takes n steps each
/// time one of them gets nearer: mind the hubs of graphs. Where surfaces and solids have classes of
/// their own (TriangleMesh, TetMesh), those can do more.
template <class Real, int N>
class SimplicialComplex {
  static_assert(is_number_of_domains<Real>, "distances are float or double");
  static_assert(N >= 1 && N <= 4, "complexes of simplices have the dimensions 1 to 4");

 public:
  /// The precision of lengths inside, and of fields.
  using Number = Real;
  /// Simplices of any one dimension.
  static constexpr DomainKind kind = DomainKind::simplices;
  /// N.
  static constexpr int dimension = N;
  /// In what order a simplex has its edges.
  using Layout = detail::SimplexLayout<N>;
  /// The record of a simplex that propagation reads.
  using Record = detail::SimplexRecord<Real, N>;
  /// Vertices of a simplex.
  using Corners = std::array<Index, N + 1>;
  /// Of a simplex, one an edge: (0,1) (0,2) (1,2) (0,3) ...
  using Lengths = std::array<double, N*(N + 1) / 2>;

  /// From intrinsic lengths: one row a simplex, in the order (0,1) (0,2) (1,2) (0,3) (1,3) (2,3)
  /// (0,4) ... of its corners (metric::simplex_edges). Two vertices have one edge: where simplices
  /// differ by rounding the mean is taken. Throws InputError naming the simplex for a vertex out of
  /// range or twice in it, a length that is negative or not finite, two lengths of one edge, and
  /// for no simplex or more than 2^28 - 1. Cost: O(n log n), about 1 us a simplex.
  SimplicialComplex(std::size_t vertices, std::span<const Corners> simplices,
                    std::span<const Lengths> lengths);

  /// From coordinates: `axes` numbers a vertex, axes >= N. Throws as above, naming the
  /// vertex for a coordinate that is not finite.
  SimplicialComplex(std::span<const double> positions, std::size_t axes,
                    std::span<const Corners> simplices);

  /// From arrays of any kind (rows_of); a row of coordinates has as many numbers as there are axes.
  template <RowsOfAnyWidth Points, RowsOfNumbers Simplices>
  SimplicialComplex(const Points& positions, const Simplices& simplices)
      : SimplicialComplex(equal_rows_of(positions), rows_of<Index, N + 1>(simplices)) {}

  /// Referenced or not: fields have one distance each.
  [[nodiscard]] std::size_t vertex_count() const { return vertex_to_inside_.size(); }
  /// Of dimension N.
  [[nodiscard]] std::size_t simplex_count() const { return records_.size(); }
  /// Intrinsic: the lengths of edges are all that is needed.
  [[nodiscard]] MetricKind metric() const { return MetricKind::intrinsic; }
  /// Its counts, made while it was built.
  [[nodiscard]] const SimplicialSummary& summary() const { return summary_; }
  /// One unit inside, in the input's: the mean edge.
  [[nodiscard]] double unit() const { return summary_.mean_edge; }
  /// Bytes this complex holds.
  [[nodiscard]] std::size_t bytes() const;

  // What follows serves the layers above and uses the numbers inside.
  /// @name For the layers above
  ///@{

  /// One a simplex, in the order inside.
  [[nodiscard]] std::span<const Record> records() const { return records_; }
  /// The number inside of a vertex, which must be one (not checked).
  [[nodiscard]] Index inside_vertex(Index vertex) const { return vertex_to_inside_[vertex]; }
  /// The number inside of each vertex, in the caller's order.
  [[nodiscard]] std::span<const Index> vertices_inside() const { return vertex_to_inside_; }
  /// Linear search: one pass over the records.
  [[nodiscard]] Index inside_simplex(Index simplex) const;
  /// N < 4: the place in the record of the caller's corner k of a simplex.
  [[nodiscard]] std::size_t place(Index inside_simplex, std::size_t k) const {
    return places_[inside_simplex] >> (2 * k) & 3;
  }
  /// Corners (N + 1) s + i at a vertex.
  [[nodiscard]] std::span<const Index> corners_at(Index inside_vertex) const {
    return std::span<const Index>(corners_).subspan(
        star_begin_[inside_vertex], star_begin_[inside_vertex + 1] - star_begin_[inside_vertex]);
  }
  /// Vertices (inside) where parts only touch, ascending.
  [[nodiscard]] std::span<const Index> pinched() const { return pinched_; }
  /// What it is solved as if it is flat; else nullptr.
  [[nodiscard]] const FlatForm<N>* flat() const { return flat_.get(); }
  /// Of a vertex (inside), in units; nothing where they are not known, or the complex is flat.
  [[nodiscard]] std::span<const double> coordinates(Index inside_vertex) const {
    return std::span<const double>(coordinates_).subspan(axes_ * inside_vertex, axes_);
  }
  ///@}

 private:
  SimplicialComplex(const EqualRows& positions, const std::vector<Corners>& simplices)
      : SimplicialComplex(positions.numbers, positions.width, simplices) {}
  void assemble(std::size_t vertices, std::span<const Corners> simplices,
                std::vector<Lengths> lengths);
  void find_stars(std::size_t vertices);
  void lay_flat(std::span<const double> positions, std::span<const Corners> simplices);
  void keep_coordinates(std::span<const double> positions, std::size_t axes);

  SimplicialSummary summary_;
  std::vector<Record> records_;
  std::vector<Index> vertex_to_inside_;
  std::vector<Index> star_begin_, corners_;
  std::vector<unsigned char> places_;  // N < 4: where the caller's corners went, two bits each
  std::vector<Index> pinched_;
  std::shared_ptr<const FlatForm<N>> flat_;
  std::size_t axes_ = 0;
  std::vector<double> coordinates_;
};

}  // namespace plexway
