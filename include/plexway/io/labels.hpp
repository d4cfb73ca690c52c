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

}  // namespace plexway::io
