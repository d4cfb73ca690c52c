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

}  // namespace plexway::io
