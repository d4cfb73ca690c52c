#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <plexway/error.hpp>
#include <plexway/io/edges.hpp>
#include <plexway/io/labels.hpp>
#include <plexway/io/mixed.hpp>
#include <plexway/io/tets.hpp>

#include "io/field/value_source.hpp"
#include "io/numbers.hpp"
#include "io/surface/polygons.hpp"

namespace plexway::io {

/// What cells of files are, whatever their order: corners come first.
enum class CellKind : std::uint8_t {
  none,  ///< not known, or not to be cut
  point,
  line,
  polyline,
  triangle,
  strip,
  polygon,
  pixel,
  quad,
  tetrahedron,
  voxel,
  hexahedron,
  prism,
  pyramid,
  five_sided_prism,
  six_sided_prism,
};

/// A type of cell: its kind, and its nodes where it has so many and no others.
struct CellType {
  CellKind kind = CellKind::none;
  std::uint32_t nodes = 0;
};

/// As vtkCellType.h numbers them.
[[nodiscard]] CellType vtk_cell_type(std::int64_t number);
/// As Gmsh's reference manual (section "Node ordering") and GmshDefines.h do.
[[nodiscard]] CellType gmsh_cell_type(std::int64_t number);

/// The least number of corners.
[[nodiscard]] std::uint32_t corners_of(CellKind kind);
/// "a quadrilateral" without the article.
[[nodiscard]] std::string_view name_of(CellKind kind);

/// Makes lines, triangles and tetrahedra of a file's cells. Hexahedra, prisms and pyramids become
/// the cones of their lowest vertices, faces are cut from theirs: so neighbours agree (Dompierre,
/// Labbe, Vallet, Camarero, How to subdivide pyramids, prisms and hexahedra into tetrahedra, 1999).
class CellTaker {
 public:
  explicit CellTaker(Mixed& cells) : cells_(cells) {}

  /// A cell of these corners, all of them vertices that are there. False where there are too few.
  [[nodiscard]] bool add(CellKind kind, std::span<const std::uint32_t> corners);
  /// Cells that cannot be taken.
  void refuse(std::string_view what, std::uint64_t count = 1) { refused_.pass_over(what, count); }
  /// Throws InputError where there were some, since a domain without them would have holes, and
  /// where a tetrahedron meets half a face of a cell that is cut along the other diagonal.
  void finish(std::string_view name);

 private:
  void add_solid(CellKind kind, std::span<const std::uint32_t> corners);

  Mixed& cells_;
  FileReport refused_;
  std::vector<std::array<std::uint32_t, 3>> halves_;  ///< of faces, by the diagonals not taken
};

/// Of what a file holds, what has that kind; the rest is passed over. Throws InputError where there
/// is none.
[[nodiscard]] Tets tets_of(Mixed cells, std::string_view name);
[[nodiscard]] Triangles triangles_of(Mixed cells, std::string_view name);
[[nodiscard]] Edges edges_of(Mixed cells, std::string_view name);
/// A surface as cells.
[[nodiscard]] Mixed mixed_of(Triangles surface);

/// Vertices at one place become the first of them, where a format cuts surfaces along seams of
/// normals and textures. Triangles of which a corner then comes twice are left out.
void close_seams(Mixed& cells);

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
