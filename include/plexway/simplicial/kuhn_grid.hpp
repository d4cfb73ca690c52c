#pragma once

#include <array>
#include <cstddef>
#include <functional>
#include <vector>

#include <plexway/simplicial/simplicial_complex.hpp>

namespace plexway {

/// A box of N = 2, 3 or 4 dimensions cut into cells by axis-parallel planes, and every cell into N!
/// simplices, one an order of the axes: each goes from the cell's lowest corner to its highest,
/// one axis after another (Freudenthal 1942, Simplizialzerlegungen von beschränkter Flachheit; Kuhn
/// 1960, Some combinatorial lemmas in topology). Neighbouring cells fit.
///
/// Vertices are numbered with axis 0 fastest. Cells may be absent (obstacles): their vertices keep
/// their numbers, and those that no other cell has belong to no simplex.
template <int N>
class KuhnGrid {
  static_assert(N >= 2 && N <= 4, "grids of dimension 2, 3 or 4");

 public:
  using Place = std::array<std::size_t, N>;  ///< of a vertex or a cell, along the axes
  /// A point of space.
  using Point = std::array<double, N>;
  /// Vertices of a simplex, from the lowest corner of its cell to the highest.
  using Simplex = std::array<Index, N + 1>;
  /// Is a cell absent?
  using Absent = std::function<bool(const Place& cell)>;

  /// So many cells along each axis, all of one size.
  /// Throws InputError for no cell, a spacing that is not > 0, or more than 2^32 - 2 vertices.
  KuhnGrid(const Place& cells, const Point& spacing, const Point& origin = {});
  /// By the coordinates of the planes across each axis, strictly ascending, at least two.
  /// Throws InputError unless they are, and for more than 2^32 - 2 vertices.
  explicit KuhnGrid(std::array<std::vector<double>, N> planes);

  /// Of all cells, absent ones included.
  [[nodiscard]] std::size_t vertex_count() const { return vertex_count_; }
  /// Along an axis.
  [[nodiscard]] std::size_t cells(std::size_t axis) const { return planes_[axis].size() - 1; }
  /// Coordinates of the planes across an axis, ascending, one more than cells.
  [[nodiscard]] const std::vector<double>& planes(std::size_t axis) const { return planes_[axis]; }

  /// The vertex at a place, which must be in the grid (not checked).
  [[nodiscard]] Index vertex(const Place& at) const;
  /// And back.
  [[nodiscard]] Place place(Index vertex) const;
  /// Where a vertex is in space.
  [[nodiscard]] Point position(Index vertex) const;
  /// The vertex nearest to a point of space.
  /// Among all, also of absent cells. Cost: N binary searches.
  [[nodiscard]] Index nearest(const Point& point) const;
  /// The middle of a cell, as a predicate of obstacles wants it.
  [[nodiscard]] Point centre(const Place& cell) const;

  /// N coordinates a vertex, as SimplicialComplex takes them.
  [[nodiscard]] std::vector<double> positions() const;
  /// The simplices of all cells that are not absent, N! a cell, cells with axis 0 fastest.
  /// `absent` is asked once a cell.
  [[nodiscard]] std::vector<Simplex> simplices(const Absent& absent = {}) const;
  /// All of it as a domain. Throws InputError if every cell is absent.
  template <class Real>
  [[nodiscard]] SimplicialComplex<Real, N> complex(const Absent& absent = {}) const {
    return SimplicialComplex<Real, N>(positions(), N, simplices(absent));
  }

 private:
  void check();

  std::array<std::vector<double>, N> planes_;
  std::size_t vertex_count_ = 0;
};

extern template class KuhnGrid<2>;
extern template class KuhnGrid<3>;
extern template class KuhnGrid<4>;

}  // namespace plexway
