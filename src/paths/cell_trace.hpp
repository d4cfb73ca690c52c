#pragma once

#include <algorithm>
#include <array>
#include <limits>
#include <span>
#include <vector>

#include <plexway/fields/read_out.hpp>
#include <plexway/paths/path.hpp>
#include <plexway/source/point_source.hpp>

#include "paths/cells.hpp"

namespace plexway::detail {

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

}  // namespace plexway::detail
