#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <string_view>
#include <vector>

#include <plexway/io/file_report.hpp>

namespace plexway::io {

/// Cells of several dimensions over shared vertices, as a file has them: nothing merged, reordered
/// or dropped but single points.
struct Mixed {
  std::vector<std::array<double, 3>> positions;         ///< finite, in file units
  std::vector<std::array<std::uint32_t, 2>> edges;      ///< 0-based, each < positions.size()
  std::vector<std::array<std::uint32_t, 3>> triangles;  ///< likewise
  std::vector<std::array<std::uint32_t, 4>> tets;       ///< likewise
  FileReport report = {};                               ///< what the reader did besides
};

/// Reads all that a file of cells has: lines, polygons, which are cut into triangles, and
/// tetrahedra, into which hexahedra, prisms and pyramids are cut alike from both sides.
/// Of cells of a higher order the corners are taken. The extension (any case) picks the format, and
/// where it is unknown the first bytes do.
///
/// What it is taken as is for the caller to say: tetrahedra if there are some, else triangles, else
/// lines, else points. Throws InputError as read_triangles, and for cells of any other kind, since
/// a domain without them would have holes; NotBuiltError for what needs a library that this build
/// lacks.
Mixed read_cells(const std::filesystem::path& file);

/// The same of bytes; `name` stands for them in messages, and its extension picks the format.
Mixed parse_cells(std::string_view bytes, const std::filesystem::path& name);

}  // namespace plexway::io
