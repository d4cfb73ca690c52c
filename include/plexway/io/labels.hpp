#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <vector>

namespace plexway::io {

/// The label that a file gives each vertex of a surface, by its extension: GIfTI (.label.gii, its
/// first array), FreeSurfer's annotation (.annot: the numbers of its colour table, -1 for what has
/// none) and label (.label: 1 for the vertices that it lists, else 0), and of any other a whole
/// number a line, one a vertex, `#` begins a comment.
///
/// Throws InputError "FILE: cause" or "FILE:LINE: cause", also where there is not one a vertex;
/// NotBuiltError for GIfTI in a build without pugixml.
[[nodiscard]] std::vector<std::int64_t> read_vertex_labels(const std::filesystem::path& file,
                                                           std::size_t vertices);

/// Which region each cell of a file belongs to, by number: materials, organs, layers of ground.
struct Regions {
  std::vector<std::int64_t> edges;      ///< one an edge, as Mixed::edges
  std::vector<std::int64_t> triangles;  ///< one a triangle, as Mixed::triangles
  std::vector<std::int64_t> tets;       ///< one a tetrahedron, as Mixed::tets
};

/// The regions of the cells that `read_cells` takes from a .msh, .vtu or .vtk. Of a .msh the first
/// physical group, 0 where there is none; of the others the whole numbers of the cell data
/// `region`, `gmsh:physical`, `MaterialIDs` or `CellEntityIds`, the first that is there.
///
/// Throws InputError as those readers do, and where a file has no such data.
[[nodiscard]] Regions read_regions(const std::filesystem::path& file);

}  // namespace plexway::io
