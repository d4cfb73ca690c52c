#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string_view>
#include <vector>

namespace plexway::io {

/// Cells of several dimensions over shared vertices, as a file has them: nothing merged, reordered
/// or dropped but single points.
struct Mixed {
  std::vector<std::array<double, 3>> positions;         ///< finite, in file units
  std::vector<std::array<std::uint32_t, 2>> edges;      ///< 0-based, each < positions.size()
  std::vector<std::array<std::uint32_t, 3>> triangles;  ///< likewise
  std::vector<std::array<std::uint32_t, 4>> tets;       ///< likewise
};

/// Reads lines, triangles and tetrahedra of one .msh, .vtu or .vtk. Of cells of a higher order the
/// corners are taken, and of a polyline its lines.
///
/// Throws InputError as read_tets does, and for a file with cells of any other kind, since a domain
/// without them would have holes.
Mixed read_mixed(const std::filesystem::path& file);

/// The extensions `read_mixed` knows, with the dot, in lower case.
std::span<const std::string_view> mixed_extensions();

/// See read_mixed.
Mixed parse_gmsh_mixed(std::string_view bytes, std::string_view name);
/// See read_mixed.
Mixed parse_vtu_mixed(std::string_view bytes, std::string_view name);
/// See read_mixed.
Mixed parse_vtk_mixed(std::string_view bytes, std::string_view name);

}  // namespace plexway::io
