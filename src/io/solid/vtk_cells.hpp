#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "cells.hpp"
#include "io/field/value_source.hpp"
#include "io/number_type.hpp"

namespace plexway::io {

/// The cells of an unstructured grid: cell c has the corners connectivity[ends[c-1]] and on, up to
/// ends[c], and starts at 0 for c = 0.
struct VtkCells {
  std::vector<std::uint64_t> ends;
  std::vector<std::uint32_t> connectivity;  ///< each less than the number of points
};

/// The number type behind a name of VTK's XML ("Float64") or legacy files ("double").
std::optional<NumberType> vtk_number_type(std::string_view name);

/// Takes cell `cell`, of type `type`. Returns what is wrong with it, or nothing.
std::optional<std::string> add_vtk_cell(CellTaker& taker, const VtkCells& cells, std::size_t cell,
                                        std::int64_t type);

/// Reads `count` points and appends them to `solid`.
template <class Source>
void read_vtk_points(Source& in, NumberType type, std::uint64_t count, Mixed& solid) {
  if (count >= most_vertices - solid.positions.size()) in.fail("more points than 32 bits count");
  solid.positions.reserve(solid.positions.size() + count);
  for (std::uint64_t i = 0; i < count; ++i) {
    std::array<double, 3> position{};
    for (std::size_t k = 0; k < 3; ++k) position[k] = in.real(type, axis_names[k]);
    solid.positions.push_back(position);
  }
}

/// Reads the number of one of `points` points.
template <class Source>
std::uint32_t read_vtk_corner(Source& in, NumberType type, std::size_t points) {
  const std::int64_t point = in.whole(type, "a point of a cell");
  if (point < 0 || static_cast<std::uint64_t>(point) >= points)
    in.fail("a cell names point " + std::to_string(point) + ", but there are " +
            std::to_string(points) + " points");
  return static_cast<std::uint32_t>(point);
}

}  // namespace plexway::io
