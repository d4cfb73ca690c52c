#pragma once

#include <filesystem>
#include <span>
#include <string_view>

#include <plexway/paths/path.hpp>

namespace plexway::io {

/// Writes paths as polylines, in their order, each from its first point to its last. Empty paths
/// (unreachable targets) leave no line.
///
/// The extension (any case) picks the format: .obj (`v` and `l`), .ply (vertices and edges), .vtp
/// (lines, with `length` and `source` of each), .csv (a point a row, with the place of its path in
/// the list), .json (also lengths, simplices and barycentric coordinates; paths without positions
/// go nowhere else). The file appears whole or not at all.
///
/// Throws UsageError for an unknown extension or, but for .json, a path without positions, and
/// Error "cannot write FILE: reason" when the system refuses.
void write_paths(const std::filesystem::path& file, std::span<const Path> paths);

/// Isolines (plexway::isolines) as paths are written; .json, .vtp and .csv have the `value` of
/// each besides, values[source]. Throws as write_paths, and UsageError for a source that has no
/// value.
void write_isolines(const std::filesystem::path& file, std::span<const Path> lines,
                    std::span<const double> values);

/// The extensions `write_paths` knows, with the dot, in lower case.
std::span<const std::string_view> path_extensions();

}  // namespace plexway::io
