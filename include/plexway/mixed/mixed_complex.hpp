#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <variant>
#include <vector>

#include <plexway/common/detail/storage.hpp>
#include <plexway/common/ids.hpp>
#include <plexway/common/rows_of.hpp>
#include <plexway/domain/concept.hpp>
#include <plexway/solid/tet_mesh.hpp>
#include <plexway/surface/triangle_mesh.hpp>
#include <plexway/wireframe/wireframe.hpp>

namespace plexway {

namespace detail {
template <class Real>
struct JoinedPieces;
}  // namespace detail

/// How two pieces are welded.
struct WeldOptions {
  /// Vertices of the two pieces are one if they are this close, in the domain's unit, >= 0.
  double tolerance = 0;
};

/// The counts of a mixed domain.
struct MixedSummary {
  ///@{
  /// Of all pieces; a welded vertex counts in each of them.
  std::size_t pieces = 0, vertices = 0, simplices = 0;
  ///@}
  std::size_t welded_vertices = 0;  ///< pairs
  /// What two pieces share, by dimension: faces, edges in no such face, vertices in no such edge.
  std::array<std::size_t, 3> hinges = {};
};

/// Complexes of different dimension in one domain, welded at vertices.
///
/// Pieces keep their own complex, so that inside each the best rule for its dimension applies.
/// Vertices and simplices are numbered through, piece after piece: a welded vertex keeps a number
/// in each of its pieces, with equal distances. Executors work on fewer pieces (`joined`), since a
/// corner that exists only once pieces are welded must bend paths as any other. Built once, then
/// read by any number of threads.
template <class Real>
class MixedComplex {
  static_assert(is_number_of_domains<Real>, "distances are float or double");

 public:
  /// The precision of lengths inside, and of fields.
  using Number = Real;
  /// A mixed domain.
  static constexpr DomainKind kind = DomainKind::mixed;
  /// The greatest that a piece may have.
  static constexpr int dimension = 3;

  /// The kinds of pieces.
  using Complex = std::variant<TriangleMesh<Real>, TetMesh<Real>, Wireframe<Real>>;

  /// A piece's place in the numbering of the whole.
  struct Piece {
    ///@{
    /// Its own number, and the first and the count of its vertices and its simplices in the whole.
    Index number, first_vertex, vertices, first_simplex, simplices;
    ///@}
    /// The number in the domain of a vertex or a simplex of this piece. Throws UsageError if there
    /// is none such.
    [[nodiscard]] Index vertex(Index of_piece) const;
    /// Likewise.
    [[nodiscard]] Index simplex(Index of_piece) const;
  };

  /// Adds a piece. `positions`, one a vertex and copied, say where it lies: they are needed to weld
  /// by nearness, and where all pieces have some, paths through solids are exact. Throws UsageError
  /// for positions of another count, a solid without coordinates, or more than 2^32 - 2 vertices or
  /// simplices in all.
  Piece add(Complex complex, const GivenPoints& positions = {});

  /// Makes nearby vertices of two pieces one. Returns how many pairs; with none, nothing changes.
  /// Throws UsageError for a piece that is not of this domain, twice the same, without positions,
  /// or a tolerance that is negative or not a number. Cost: linear.
  std::size_t weld(const Piece& a, const Piece& b, const WeldOptions& options = {});

  /// The same for given pairs (vertex of a, vertex of b), in the pieces' own numbers.
  std::size_t weld(const Piece& a, const Piece& b, std::span<const std::array<Index, 2>> pairs);

  /// Of all pieces; a welded vertex counts in each of them. Fields have one distance each.
  [[nodiscard]] std::size_t vertex_count() const { return summary_.vertices; }
  /// Of all pieces.
  [[nodiscard]] std::size_t simplex_count() const { return summary_.simplices; }
  /// Intrinsic, whatever its pieces have.
  [[nodiscard]] MetricKind metric() const { return MetricKind::intrinsic; }
  /// Its counts.
  [[nodiscard]] const MixedSummary& summary() const { return summary_; }
  /// In the order in which they were added.
  [[nodiscard]] std::span<const Piece> pieces() const { return pieces_; }
  /// The complex of a piece, which must be of this domain (not checked).
  [[nodiscard]] const Complex& complex(const Piece& piece) const {
    return complexes_[piece.number];
  }
  /// Bytes this domain holds.
  [[nodiscard]] std::size_t bytes() const;

  // What follows serves the layers above and uses the numbers inside the pieces.
  /// @name For the layers above
  ///@{

  /// This domain with surfaces that share edges joined to one, and solids that share faces and
  /// measure them alike, where that makes no corner; null where there are none. Made when first
  /// asked for, after the last change; may be called by several threads.
  [[nodiscard]] std::shared_ptr<const detail::JoinedPieces<Real>> joined() const;

  /// What strings know of it (src/strings); of it as it was when that was first wanted.
  [[nodiscard]] const detail::OnDemand& space() const { return space_; }

  /// Where the vertices of a piece lie, as it was added; may be empty.
  [[nodiscard]] std::span<const std::array<double, 3>> positions(const Piece& piece) const {
    return positions_[piece.number];
  }

  /// A simplex at a hinge: its number, and which of its corners are the hinge's vertices 0 .. K.
  struct Member {
    /// The number inside its piece.
    Index simplex;
    /// Its corners that are the hinge's vertices; as many as the hinge has.
    std::array<std::uint8_t, 3> corner;
  };
  /// A hinge of dimension 1 or 2 between two pieces.
  struct Hinge {
    /// 1 or 2: an edge or a triangle.
    std::uint8_t dimension;
    /// The pieces on either side.
    Index piece[2];
    /// A simplex of each at it.
    Member member[2];
  };
  /// Two vertices that are one.
  struct Weld {
    ///@{
    /// The two pieces, and the vertex inside each.
    Index piece[2], vertex[2];
    ///@}
  };
  /// Triangles that two pieces have, and edges in no such triangle.
  [[nodiscard]] std::span<const Hinge> hinges() const { return hinges_; }
  /// All pairs of vertices that are one.
  [[nodiscard]] std::span<const Weld> welds() const { return welds_; }
  /// The same pairs in the domain's numbers.
  [[nodiscard]] std::span<const std::array<Index, 2>> outer_welds() const { return outer_welds_; }
  ///@}

 private:
  friend struct detail::JoinedPieces<Real>;
  void check(const Piece& a, const Piece& b) const;

  MixedSummary summary_;
  std::vector<Piece> pieces_;
  std::vector<Complex> complexes_;
  std::vector<std::vector<std::array<double, 3>>> positions_;
  std::vector<Hinge> hinges_;
  std::vector<Weld> welds_;
  std::vector<std::array<Index, 2>> outer_welds_;
  mutable std::shared_ptr<const detail::JoinedPieces<Real>> joined_;
  mutable bool is_joined_ = false;  // or found to need none
  detail::OnDemand space_;
};

extern template class MixedComplex<float>;
extern template class MixedComplex<double>;

}  // namespace plexway
