#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <unordered_map>
#include <unordered_set>
#include <variant>
#include <vector>

#include <plexway/fields/read_out.hpp>
#include <plexway/mixed/mixed_complex.hpp>
#include <plexway/paths/path.hpp>
#include <plexway/source/point_source.hpp>

#include "complexes/common/geometry.hpp"

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

/// What paths over cells need of a field.
struct CellField {
  const Cells& cells;
  std::span<const double> distance;                  ///< by number in Cells
  std::span<const PointSource> sources;              ///< those that it is the field of
  std::span<const std::array<double, 3>> positions;  ///< one a vertex of the domain; may be empty
  bool in_space = false;  ///< are lengths those between positions, if there are some?
};

/// A field's distances by number in Cells.
template <class Real>
std::vector<double> cell_distances(const Cells& cells, std::span<const Real> field) {
  std::vector<double> distance(cells.vertex_count(), std::numeric_limits<double>::infinity());
  for (std::size_t v = 0; v < field.size(); ++v) {
    double& d = distance[cells.vertex(static_cast<Index>(v))];
    d = std::min(d, static_cast<double>(field[v]));
  }
  return distance;
}

/// A shortest path from vertices' distances alone: the shortest way over places in the cells
/// (search_cells), pulled taut, and searched again over places around the vertices and edges that
/// hold it, until nothing is gained. Where that is longer by more than 3e-4 than the distance,
/// inside a cell than a way by one of its corners, or at a vertex shorter by more than 1e-2, so
/// that the distance is off, with more places. An empty path where none leads.
Path trace_cells(const CellField& field, const PointSource& point);

/// The distance of a point: the length of its path, but inside of a cell none longer than by a
/// corner. +inf where unreachable.
double read_cells(const CellField& field, const PointSource& point, ReadOut level);

/// Where a way goes from a cell into the next: a point of a face that both have.
struct CellCrossing {
  CellFace face;
  std::array<double, 3> at = {};  ///< a coordinate for each vertex of the face, >= 0, sum 1
};

/// A way from a point to another: straight in each of its cells.
struct CellString {
  std::vector<Index> cells;
  std::array<double, 4> start = {}, end = {};  ///< points of the first and of the last cell
  std::vector<CellCrossing> crossings;         ///< between cells k and k + 1

  /// The ends of leg k, in cell k.
  [[nodiscard]] std::array<std::array<double, 4>, 2> leg(const Cell& cell, std::size_t k) const;
  /// Of leg k.
  [[nodiscard]] double length(const Cells& all, std::size_t k) const;
  [[nodiscard]] double length(const Cells& all) const;
  /// Of crossing k, as coordinates in a cell that has its face.
  [[nodiscard]] std::array<double, 4> place(const Cell& cell, std::size_t k) const;
};

/// The point of a cell.
Point3 place_in(const Cell& cell, const std::array<double, 4>& at);

/// Moves the crossings to where the way through these cells is shortest. That is one minimum, since
/// lengths are convex in the crossings: Newton's method with a barrier that keeps them in their
/// faces (Nesterov, Nemirovskii 1994), whose Hessian is a band. Good to 1e-12 of the length; never
/// longer than before. Cost: about 40 steps, linear in the cells.
void pull_taut(const Cells& all, CellString& string);

/// A point of a cell, or a vertex by its number in Cells.
struct CellPoint {
  Index vertex = none;
  Index cell = none;
  std::array<double, 4> at = {};
};

/// Where ways may end.
struct CellGoal {
  CellPoint point;
  double offset = 0;
};

/// A way as it was found, and the goal that it leads to.
struct CellWay {
  CellString string;
  std::size_t goal = 0;
};

/// Places of a face that ways may pass: a coordinate for each vertex of it.
using FacePlaces = std::vector<std::array<double, 3>>;

/// Some cells, and places of their vertices, edges and faces.
struct Corridor {
  struct Hash {
    std::size_t operator()(const CellFace& face) const {
      std::uint64_t h = face.corners;
      for (const Index v : face.vertex) h = (h ^ v) * 0x9e3779b97f4a7c15ull, h ^= h >> 29;
      return static_cast<std::size_t>(h);
    }
  };
  std::unordered_set<Index> cells;
  std::unordered_map<CellFace, FacePlaces, Hash> places;
};

/// The shortest way over places: the vertices, and some points of the edges and faces that cells
/// share (Lanthier, Maheshwari, Sack 1997). A* by what the distances of a cell's vertices say is
/// left at least, so a little more is looked at than what the way passes. Nothing where no way
/// leads. `distance`, by number in Cells, are those of the goals; `places` an edge. Cost: about 3
/// us a cell looked at with two places.
std::optional<CellWay> search_cells(const Cells& all, std::span<const double> distance,
                                    std::span<const CellGoal> goals, const CellPoint& start,
                                    std::size_t places);
/// The same over the places of a corridor alone, whatever the distances.
std::optional<CellWay> search_cells(const Cells& all, const Corridor& corridor,
                                    std::span<const CellGoal> goals, const CellPoint& start);

}  // namespace plexway::detail
