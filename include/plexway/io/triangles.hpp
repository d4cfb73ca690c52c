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

/// Wavefront OBJ: `v` and `f` (all index forms, negative indices, `\` at a line's end); all other
/// statements are ignored. `name` stands for the file in messages. Throws InputError.
Triangles parse_obj(std::string_view text, std::string_view name);

/// Object File Format, ascii: OFF and its C, N and ST variants. Throws InputError.
Triangles parse_off(std::string_view text, std::string_view name);

/// Stanford PLY: ascii, binary little and big endian. Throws InputError.
Triangles parse_ply(std::string_view bytes, std::string_view name);

/// STL, ascii or binary. It is a soup of triangles: corners with identical coordinates become one
/// vertex, numbered in order of first appearance. Throws InputError.
Triangles parse_stl(std::string_view bytes, std::string_view name);

/// GIfTI (.surf.gii): its first arrays of points and of triangles; ascii, base64, and base64 of
/// zlib. Its transforms to other spaces are not applied. Throws InputError, and NotBuiltError
/// without pugixml, or zlib where it is packed.
Triangles parse_gifti(std::string_view bytes, std::string_view name);

/// FreeSurfer's binary surfaces of triangles, such as lh.white. Throws InputError.
Triangles parse_freesurfer(std::string_view bytes, std::string_view name);

/// The labels in a GIfTI file (.label.gii), one a vertex: its first array. Throws as parse_gifti.
std::vector<std::int32_t> read_gifti_labels(const std::filesystem::path& file);

}  // namespace plexway::io
