#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string_view>
#include <vector>

#include <plexway/io/file_report.hpp>

namespace plexway::io {

/// A tetrahedral solid as a file has it: nothing merged, reordered or dropped.
///
/// Vertex i is the i-th vertex of the file, referenced or not, whatever number the file gives it.
struct Tets {
  std::vector<std::array<double, 3>> positions;    ///< finite, in file units
  std::vector<std::array<std::uint32_t, 4>> tets;  ///< 0-based, each < positions.size()
  FileReport report = {};                          ///< what the reader did besides
};

/// Reads the solid in `file`; the extension (any case) picks the format. Cells that are no
/// tetrahedra are passed over, and of a tetrahedron of higher order the four corners are taken.
///
/// Of TetGen's pair either name will do; the other file must lie beside it.
/// Throws InputError, one line "FILE:LINE: cause" or "FILE: cause", when the file is missing,
/// truncated or malformed, holds a coordinate that is not finite, an index out of range or no
/// tetrahedron, or when the extension is not known; NotBuiltError when a .vtu needs a library that
/// this build lacks.
Tets read_tets(const std::filesystem::path& file);

/// Writes the solid; the extension (any case) picks the format. It reads back the same, to the last
/// bit. The file appears whole or not at all. Either of .node and .ele writes both files.
///
/// Throws UsageError for an unknown extension, a coordinate that is not finite or an index out of
/// range, and Error "cannot write FILE: reason" when the system refuses.
void write_tets(const std::filesystem::path& file, const Tets& solid);

/// The extensions `read_tets` and `write_tets` know, with the dot, in lower case.
std::span<const std::string_view> tet_extensions();

/// The bytes of a file and what it is called in messages.
struct NamedText {
  /// All of the file; referred to.
  std::string_view text;
  /// Its name in messages; referred to.
  std::string_view name;
};

/// TetGen's .node and .ele, numbered from 0 or 1; tetrahedra of 4 or 10 nodes. Throws InputError.
Tets parse_node_ele(NamedText node, NamedText ele);

/// MEDIT's .mesh, ascii, in three dimensions; sections in any order. Throws InputError.
Tets parse_medit(std::string_view text, std::string_view name);

/// Gmsh's .msh, versions 2.0 to 2.2 and 4.1, ascii or binary of either byte order; node tags may
/// be any numbers. Throws InputError.
Tets parse_gmsh(std::string_view bytes, std::string_view name);

/// VTK's XML unstructured grid: ascii, base64 or raw, compressed by zlib or not, either byte order,
/// any number of pieces. Throws InputError, or NotBuiltError where pugixml or zlib is missing.
Tets parse_vtu(std::string_view bytes, std::string_view name);

/// VTK's legacy .vtk with an unstructured grid, versions up to 5.1, ascii or binary. Throws
/// InputError.
Tets parse_vtk(std::string_view bytes, std::string_view name);

}  // namespace plexway::io
