#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string_view>
#include <vector>

#include <plexway/io/file_report.hpp>

/// The component `io`, link plexway::io: files in and out, as plain arrays.
namespace plexway::io {

/// A triangle surface as a file has it: nothing merged, reordered or dropped.
///
/// Vertex i is the i-th vertex of the file, referenced or not. Polygons with more than three
/// corners are cut into triangles, in file order: quads along the shorter diagonal that lies
/// inside, convex ones as a fan around their first corner, others by clipping ears.
struct Triangles {
  std::vector<std::array<double, 3>> positions;         ///< finite, in file units
  std::vector<std::array<std::uint32_t, 3>> triangles;  ///< 0-based, each < positions.size()
  FileReport report = {};                               ///< what the reader did besides
};

/// Reads the surface in `file`; the extension (any case) picks the format.
///
/// Throws InputError, one line "FILE:LINE: cause" or "FILE: cause", when the file is missing,
/// truncated or malformed, holds a coordinate that is not finite, an index out of range, a face
/// with fewer than three corners, no face at all, or when the extension is not known.
Triangles read_triangles(const std::filesystem::path& file);

/// Writes the surface; the extension (any case) picks the format. Nothing is rounded but in
/// .stl, .glb and .gltf, which hold single precision; .vtu, .vtk, .glb and .gltf are read again by
/// `read_cells`. The file appears whole or not at all.
///
/// Throws UsageError for an unknown extension, a coordinate that is not finite or, in single
/// precision, too large, an index out of range, and Error "cannot write FILE: reason" when the
/// system refuses.
void write_triangles(const std::filesystem::path& file, const Triangles& surface);

/// The extensions `write_triangles` knows, with the dot, in lower case.
std::span<const std::string_view> triangle_output_extensions();

/// The labels in a GIfTI file (.label.gii), one a vertex: its first array. Throws InputError, and
/// NotBuiltError without pugixml, or zlib where it is packed.
std::vector<std::int32_t> read_gifti_labels(const std::filesystem::path& file);

}  // namespace plexway::io
