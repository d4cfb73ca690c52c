#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <variant>
#include <vector>

#include <plexway/mixed/mixed_complex.hpp>

#include "complexes/common/point3.hpp"

namespace plexway::detail {

/// A simplex of a mixed domain: an edge, a triangle or a tetrahedron, in a frame of its own.
struct Cell {
  std::size_t corners = 0;
  std::array<Index, 4> vertex = {none, none, none, none};  ///< numbers of Cells
  std::array<Point3, 4> place = {};  ///< in the domain's unit, as its piece measures it

  /// Which corner a vertex is, or `corners`.
  [[nodiscard]] std::size_t corner(Index v) const {
    std::size_t i = 0;
    while (i < corners && vertex[i] != v) ++i;
    return i;
  }
};

/// What two cells have in common, or a part of it: up to three vertices, ascending.
struct CellFace {
  std::size_t corners = 0;
  std::array<Index, 3> vertex = {none, none, none};

  void add(Index v) {
    std::size_t i = corners++;
    for (; i > 0 && vertex[i - 1] > v; --i) vertex[i] = vertex[i - 1];
    vertex[i] = v;
  }
  [[nodiscard]] bool has(Index v) const {
    return vertex[0] == v || vertex[1] == v || vertex[2] == v;
  }
  friend bool operator==(const CellFace&, const CellFace&) = default;
};

/// A complex that cells are taken from, and where its numbers begin among all.
template <class Real>
struct CellPiece {
  std::variant<const TriangleMesh<Real>*, const TetMesh<Real>*, const Wireframe<Real>*> complex;
  Index first_vertex = 0, vertices = 0, first_simplex = 0, simplices = 0;
};

/// The simplices of all pieces of a mixed domain as cells that meet where they have vertices in
/// common: welded vertices are one. A wire meets others at vertices alone, as when distances are
/// found. Numbers of simplices are the domain's, corners in the caller's order.
class Cells {
 public:
  using Welds = std::span<const std::array<Index, 2>>;
  template <class Real>
  Cells(std::span<const CellPiece<Real>> pieces, Welds welds);
  Cells(const Cells&) = delete;
  Cells& operator=(const Cells&) = delete;
  virtual ~Cells() = default;

  [[nodiscard]] virtual Cell cell(Index simplex) const = 0;
  /// The corners of a simplex as vertices of the domain; none beyond.
  [[nodiscard]] virtual std::array<Index, 4> outer_corners(Index simplex) const = 0;

  /// A vertex of the domain by the number of all that are one with it.
  [[nodiscard]] Index vertex(Index outer) const { return vertex_[outer]; }
  [[nodiscard]] std::size_t vertex_count() const { return around_begin_.size() - 1; }
  /// The simplices at a vertex, ascending.
  [[nodiscard]] std::span<const Index> around(Index vertex) const {
    return std::span(around_).subspan(around_begin_[vertex],
                                      around_begin_[vertex + 1] - around_begin_[vertex]);
  }
  /// The simplices that have all of a face; those at a vertex where it is one.
  void around(const CellFace& face, std::vector<Index>& simplices) const;
  /// Are all simplices edges, so that ways meet at vertices alone?
  [[nodiscard]] bool only_edges() const { return corner_.size() == 2 * (corner_begin_.size() - 1); }
  /// The corners of a simplex that has some.
  [[nodiscard]] std::span<const Index> corners(Index simplex) const;
  /// What two different simplices share. At most three vertices; only `at` where one is a wire.
  [[nodiscard]] CellFace between(Index one, Index other, const CellFace& at) const;
  [[nodiscard]] std::size_t bytes() const;

 protected:
  std::vector<Index> outer_;  ///< the domain's vertices by their numbers inside, piece by piece

 private:
  std::vector<Index> vertex_;  // by vertex of the domain
  std::vector<std::uint32_t> corner_begin_;
  std::vector<Index> corner_;
  std::vector<std::uint32_t> around_begin_;
  std::vector<Index> around_;
};

/// Of a mixed domain, a surface whose triangles may measure their edges differently, a solid, which
/// may have intrinsic lengths, or a wireframe; it must outlive them.
template <class Real>
class ComplexCells final : public Cells {
 public:
  explicit ComplexCells(const MixedComplex<Real>& domain);
  explicit ComplexCells(const TriangleMesh<Real>& surface);
  explicit ComplexCells(const TetMesh<Real>& solid);
  explicit ComplexCells(const Wireframe<Real>& wireframe);
  [[nodiscard]] Cell cell(Index simplex) const override;
  [[nodiscard]] std::array<Index, 4> outer_corners(Index simplex) const override;

 private:
  using Pieces = std::vector<CellPiece<Real>>;
  ComplexCells(Pieces pieces, Welds welds);
  [[nodiscard]] const CellPiece<Real>& piece_of(Index simplex) const;

  Pieces pieces_;
};

}  // namespace plexway::detail
