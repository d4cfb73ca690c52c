#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "paths/cells.hpp"

namespace plexway::detail {

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

}  // namespace plexway::detail
