#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <unordered_map>
#include <unordered_set>
#include <vector>

#include "paths/cell_string.hpp"

namespace plexway::detail {

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
