#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include <plexway/io/edges.hpp>
#include <plexway/io/mixed.hpp>
#include <plexway/io/points.hpp>
#include <plexway/io/tets.hpp>
#include <plexway/io/triangles.hpp>

namespace plexway::io {

// What formats.cpp knows to read besides what the public headers have. `name` stands for the file
// in messages. All throw InputError.

/// Vertices, faces and lines.
Mixed parse_obj_cells(std::string_view text, std::string_view name);
/// Vertices, faces, triangle strips and edges.
Mixed parse_ply_cells(std::string_view bytes, std::string_view name);
Mixed parse_medit_cells(std::string_view text, std::string_view name);
/// FreeSurfer's surfaces as text: "#!ascii", the counts, "x y z patch" and "a b c patch".
Triangles parse_freesurfer_ascii(std::string_view text, std::string_view name);

/// Finds the file that a .gltf names: its bytes.
using GltfFiles = std::function<std::string(const std::string& uri)>;
/// As parse_gltf; `beside` may be empty.
Mixed parse_gltf_files(std::string_view bytes, std::string_view name, const GltfFiles& beside);

/// TetGen's pair, from the name of either.
Tets read_node_ele(const std::filesystem::path& file);
/// Throws NotBuiltError for a .pcd, which another component reads and writes.
void refuse_pcd(std::string_view extension, const std::string& name);

/// The numbers in the colour table that an annotation of FreeSurfer (.annot) gives its vertices; -1
/// for a colour that the table has not. Throws InputError "FILE: cause".
[[nodiscard]] std::vector<std::int64_t> read_freesurfer_annotation(
    const std::filesystem::path& file);
/// The same of bytes; `name` is for messages.
[[nodiscard]] std::vector<std::int64_t> parse_freesurfer_annotation(std::string_view bytes,
                                                                    std::string_view name);

}  // namespace plexway::io
