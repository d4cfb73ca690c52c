#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <string>
#include <string_view>

#include <plexway/io/regions.hpp>

#include "cells.hpp"
#include "io/number_type.hpp"

namespace plexway::io {

/// The regions of all cells that are taken; `name` stands for the file in messages.
Regions parse_gmsh_regions(std::string_view bytes, std::string_view name);
Regions parse_vtu_regions(std::string_view bytes, std::string_view name);
Regions parse_vtk_regions(std::string_view bytes, std::string_view name);

/// Names of cell data that hold regions, the best first.
inline constexpr std::array<std::string_view, 4> region_names = {"region", "gmsh:physical",
                                                                 "MaterialIDs", "CellEntityIds"};
/// Its place among them, or their number.
inline std::size_t region_rank(std::string_view name) {
  std::size_t rank = 0;
  while (rank < region_names.size() && region_names[rank] != name) ++rank;
  return rank;
}

[[noreturn]] inline void no_regions(std::string_view name) {
  throw InputError(std::string(name) +
                   ": has no regions: no cell data region, gmsh:physical, MaterialIDs or "
                   "CellEntityIds");
}

/// A region's number, whole even where the array is one of real numbers.
template <class Source>
std::int64_t read_region(Source& in, NumberType type) {
  if (type != NumberType::f32 && type != NumberType::f64)
    return in.whole(type, "the region of a cell");
  const double region = in.real(type, "the region of a cell");
  if (region != std::floor(region) || !(std::abs(region) < 9e15))
    in.fail("the region of a cell is no whole number");
  return static_cast<std::int64_t>(region);
}

/// Which of a file's cells each cell that was taken comes from; a polyline is several edges.
struct CellOwners {
  std::vector<std::size_t> edges, triangles, tets;

  /// Cell `cell` is done: whatever is new is its.
  void take(const Mixed& cells, std::size_t cell) {
    edges.resize(cells.edges.size(), cell);
    triangles.resize(cells.triangles.size(), cell);
    tets.resize(cells.tets.size(), cell);
  }
  /// The regions of cells from those of the file's.
  [[nodiscard]] Regions regions(const std::vector<std::int64_t>& of_cell) const {
    const auto look_up = [&](const std::vector<std::size_t>& owners) {
      std::vector<std::int64_t> found;
      found.reserve(owners.size());
      for (const std::size_t cell : owners) found.push_back(of_cell[cell]);
      return found;
    };
    return {look_up(edges), look_up(triangles), look_up(tets)};
  }
};

}  // namespace plexway::io
