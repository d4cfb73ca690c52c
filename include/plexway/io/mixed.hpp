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
/// corners are taken, of a polyline its lines, and polygons are cut into fans.
///
/// Throws InputError as read_tets does, and for a file with cells of any other kind, since a domain
/// without them would have holes.
Mixed read_mixed(const std::filesystem::path& file);

/// The extensions `read_mixed` knows, with the dot, in lower case.
std::span<const std::string_view> mixed_extensions();

/// Reads whatever a file has that may hold several kinds: .msh, .vtu, .vtk, .vtp, .glb or .gltf.
/// What it is taken as is for the caller to say: tetrahedra if there are some, else triangles, else
/// lines, else points. Beside tetrahedra cells of other kinds are passed over.
///
/// Throws InputError as read_mixed, and for a file without any points; NotBuiltError for what needs
/// a library that this build lacks.
Mixed read_cells(const std::filesystem::path& file);

/// The extensions `read_cells` knows, with the dot, in lower case.
std::span<const std::string_view> cell_extensions();

/// See read_cells.
Mixed parse_gmsh_cells(std::string_view bytes, std::string_view name);
/// See read_cells.
Mixed parse_vtu_cells(std::string_view bytes, std::string_view name);
/// See read_cells.
Mixed parse_vtk_cells(std::string_view bytes, std::string_view name);
/// glTF 2.0, all meshes of its scene where its nodes put them: points, lines and triangles of their
/// positions, in base64 or in the file itself. Its format cuts surfaces along seams of textures and
/// normals: vertices at one place become one, but in files of plexway, which have none. Throws
/// InputError, also for what is packed (Draco, meshopt) or lies in another file; NotBuiltError
/// where nlohmann-json was missing.
Mixed parse_gltf(std::string_view bytes, std::string_view name);

/// See read_mixed.
Mixed parse_gmsh_mixed(std::string_view bytes, std::string_view name);
/// See read_mixed.
Mixed parse_vtu_mixed(std::string_view bytes, std::string_view name);
/// See read_mixed.
Mixed parse_vtk_mixed(std::string_view bytes, std::string_view name);

}  // namespace plexway::io
