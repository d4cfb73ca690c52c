#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <plexway/error.hpp>
#include <plexway/io/edges.hpp>
#include <plexway/io/mixed.hpp>
#include <plexway/io/tets.hpp>

#include "io/surface/surface_checks.hpp"

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

}  // namespace plexway::io
