#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "paths/cell_string.hpp"

namespace plexway {

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

/// The shortest way over places: the vertices, and some points of the edges and faces that cells
/// share (Lanthier, Maheshwari, Sack 1997). A* by what the distances of a cell's vertices say is
/// left at least, so a little more is looked at than what the way passes. Nothing where no way
/// leads. `distance`, by number in Cells, are those of the goals; `places` an edge. Cost: about 3
/// us a cell looked at with two places.
std::optional<CellWay> search_cells(const Cells& all, std::span<const double> distance,
                                    std::span<const CellGoal> goals, const CellPoint& start,
                                    std::size_t places);

}  // namespace plexway
