#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>

#include <plexway/common/detail/storage.hpp>
#include <plexway/common/ids.hpp>
#include <plexway/common/rows_of.hpp>
#include <plexway/domain/concept.hpp>
#include <plexway/solid/detail/tet_record.hpp>

namespace plexway {

namespace detail {
struct KeptParts;
struct TetLayout;
}  // namespace detail

/// The counts of a solid, made while it is built.
struct SolidSummary {
  /// Referenced or not: as many as were given.
  std::size_t vertices = 0;
  /// Tetrahedra.
  std::size_t tets = 0;
  std::size_t edges = 0;           ///< distinct
  std::size_t faces = 0;           ///< distinct
  std::size_t boundary_faces = 0;  ///< of one tetrahedron only
  std::size_t reflex_edges = 0;    ///< with more than pi of solid around: paths bend there
  /// By lengths: boundary edges with more than pi + `notch` of solid around.
  std::size_t notch_edges = 0;
  static constexpr double notch = 0.25;   ///< more than a metric that varies bends a flat boundary
  std::size_t reflex_vertices = 0;        ///< ends of reflex edges, and pinched vertices
  std::size_t pinched_vertices = 0;       ///< tetrahedra touch there in the vertex only
  std::size_t pinched_edges = 0;          ///< tetrahedra touch there in the edge only
  std::size_t unreferenced_vertices = 0;  ///< in no tetrahedron: unreachable
  std::size_t degenerate_tets = 0;        ///< no volume, in the input's precision
  std::size_t inverted_tets = 0;          ///< negative volume as given; turned over
  /// The lowest number of such a tetrahedron; none: there is none.
  Index first_degenerate = none, first_inverted = none;  ///< the first such, if there is one
  std::size_t components = 0;  ///< of tetrahedra joined by faces or pinched edges or vertices
  double mean_edge = 0;        ///< in the input's unit; the library works in this unit inside
  bool embedded = false;       ///< has coordinates
};

/// A solid made of tetrahedra, glued where two share a face.
///
/// With coordinates it is a part of Euclidean space; with intrinsic lengths a piecewise flat
/// metric. Boundary, several components, vertices and edges where tetrahedra only touch,
/// unreferenced vertices and tetrahedra without volume are all allowed. Immutable once built, so
/// any number of threads may read it.
///
/// Vertices and tetrahedra have the caller's numbers in this interface. Inside they are reordered
/// for locality. Memory: 56 bytes a tetrahedron and 32 a vertex; by lengths alone 80 (double: 104).
template <class Real>
class TetMesh {
  static_assert(is_number_of_domains<Real>, "distances are float or double");

 public:
  /// The precision of lengths inside, and of fields.
  using Number = Real;
  /// A solid.
  static constexpr DomainKind kind = DomainKind::solid;
  /// Of its simplices.
  static constexpr int dimension = 3;

  /// From coordinates. Shapes: n positions in any unit, m tetrahedra of vertex indices < n, in
  /// either orientation. Throws InputError naming the vertex, tetrahedron or face for a coordinate
  /// that is not finite, an index out of range, the same vertex twice in a tetrahedron, no
  /// tetrahedron, more than two tetrahedra on a face, two on the same side of one, or more than
  /// 2^30 - 2 tetrahedra. Built by `threads` (0: as many as the machine has), which the result does
  /// not depend on. Cost: about 0.3 us a tetrahedron on one.
  TetMesh(const GivenPoints& positions, const GivenSimplices<4>& tets, int threads = 0);

  /// From intrinsic lengths: lengths[t] are those of the edges of tetrahedron t (0,1) (0,2) (1,2)
  /// (0,3) (1,3) (2,3), as metric::simplex_edges names them, and must be the same wherever an edge
  /// occurs (up to rounding; not checked). Lengths that no tetrahedron has are replaced by those of
  /// the nearest flat one along that order (SolidSummary::degenerate_tets counts). Throws as above,
  /// and for a length that is negative or not finite.
  TetMesh(std::size_t vertices, const GivenSimplices<4>& tets,
          const Given<std::array<double, 6>>& lengths, int threads = 0);

  /// n, referenced or not: fields have one distance each.
  [[nodiscard]] std::size_t vertex_count() const { return vertex_to_inside_.size(); }
  /// m, the tetrahedra.
  [[nodiscard]] std::size_t tet_count() const { return tet_to_inside_.size(); }
  /// The same: tetrahedra are a solid's simplices.
  [[nodiscard]] std::size_t simplex_count() const { return tet_count(); }
  /// Embedded where it has coordinates, else intrinsic.
  [[nodiscard]] MetricKind metric() const {
    return summary_.embedded ? MetricKind::embedded : MetricKind::intrinsic;
  }
  /// Its counts, made while it was built.
  [[nodiscard]] const SolidSummary& summary() const { return summary_; }
  /// Has it coordinates?
  [[nodiscard]] bool embedded() const { return summary_.embedded; }
  /// The mean edge, in the input's unit.
  [[nodiscard]] double unit() const { return summary_.mean_edge; }
  /// Bytes this complex holds, with what solves have made of it.
  [[nodiscard]] std::size_t bytes() const;

  // What follows serves the layers above and uses the numbers inside.
  /// @name For the layers above
  ///@{

  /// An edge that fans of tetrahedra share without sharing a face at it.
  struct PinchedEdge {
    /// Its ends.
    Index vertex[2];
    /// Its tetrahedra in pinched_edge_tets.
    Index begin, end;  ///< its tetrahedra in pinched_edge_tets
  };
  /// Marks a tetrahedron that was turned over in the translation behind inside_tet.
  static constexpr Index turned = Index{1} << 31;

  /// The records, and one sentinel behind them that stands for "no tetrahedron".
  [[nodiscard]] std::span<const detail::TetRecord> tets() const { return tets_; }
  /// Positions in units of the mean edge about the middle of the solid; empty if not embedded. In
  /// double whatever Real is: what is flat, and what bends a path, is told by their digits.
  [[nodiscard]] std::span<const detail::Vector3<double>> points() const { return points_; }
  /// Squared lengths of a tetrahedron's edges; empty if embedded.
  [[nodiscard]] std::span<const std::array<Real, 6>> squared_lengths() const { return lengths_; }
  /// Edges of the boundary whose two faces lie on each other, so that the solid goes all around:
  /// their ends, inside.
  [[nodiscard]] std::span<const std::array<Index, 2>> cracks() const { return cracks_; }
  /// The number inside of each vertex, in the caller's order.
  [[nodiscard]] std::span<const Index> vertices_inside() const { return vertex_to_inside_; }
  /// The number inside of a vertex, which must be one (not checked).
  [[nodiscard]] Index inside_vertex(Index vertex) const { return vertex_to_inside_[vertex]; }
  /// The second is true if its last two corners are exchanged here.
  [[nodiscard]] std::pair<Index, bool> inside_tet(Index tet) const {
    return {tet_to_inside_[tet] & ~turned, (tet_to_inside_[tet] & turned) != 0};
  }
  /// Corners 4 t + i at a vertex.
  [[nodiscard]] std::span<const Index> corners_at(Index inside_vertex) const {
    return std::span<const Index>(corners_).subspan(
        corners_begin_[inside_vertex],
        corners_begin_[inside_vertex + 1] - corners_begin_[inside_vertex]);
  }
  /// Vertices (inside) where tetrahedra touch in the vertex only, ascending.
  [[nodiscard]] std::span<const Index> pinched() const { return pinched_; }
  /// Edges where fans of tetrahedra only touch.
  [[nodiscard]] std::span<const PinchedEdge> pinched_edges() const { return pinched_edges_; }
  /// The tetrahedra at these, edge by edge.
  [[nodiscard]] std::span<const Index> pinched_edge_tets() const { return pinched_edge_tets_; }
  /// Of the content: a copy has the same, everything else another (Identity).
  [[nodiscard]] std::uint64_t identity() const { return identity_.value(); }
  /// What strings know of it (src/strings).
  [[nodiscard]] const detail::OnDemand& space() const { return space_; }
  ///@}

 private:
  friend struct detail::KeptParts;
  TetMesh() = default;

  void assemble(detail::TetLayout&& layout, std::span<const std::array<double, 3>> scaled,
                std::span<const std::array<double, 6>> lengths, int threads);

  SolidSummary summary_;
  detail::Identity identity_;
  detail::OnDemand space_;
  detail::Rows<detail::TetRecord, detail::Unfilled<detail::TetRecord>> tets_;
  detail::Rows<detail::Vector3<double>> points_;
  detail::Rows<std::array<Real, 6>> lengths_;
  detail::Rows<std::array<Index, 2>> cracks_;
  detail::Rows<Index> vertex_to_inside_;
  detail::Rows<Index> tet_to_inside_;  // and `turned`
  detail::Rows<Index> corners_begin_, corners_;
  detail::Rows<Index> pinched_;
  detail::Rows<PinchedEdge> pinched_edges_;
  detail::Rows<Index> pinched_edge_tets_;
};

/// Of the numbers that the points are: float, or double.
template <detail::AnyRows Points, detail::AnyRows Tets>
TetMesh(const Points&, const Tets&, int = 0) -> TetMesh<detail::NumberOf<Points>>;

extern template class TetMesh<float>;
extern template class TetMesh<double>;

}  // namespace plexway
