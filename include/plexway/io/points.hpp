#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string_view>
#include <vector>

#include <plexway/io/file_report.hpp>

namespace plexway::io {

/// A cloud of points as a file has it: nothing merged, reordered or dropped.
struct Points {
  std::vector<std::array<double, 3>> positions;  ///< finite, in file units
  /// One a point, finite, as long as the file has them (usually 1; 0 0 0 where none is known);
  /// empty if the file has none.
  std::vector<std::array<double, 3>> normals;
  /// Of what is left of a file's points: the number that each had there, ascending. Empty: all are
  /// there. Fields are written with it as a column, so that they join with the file.
  std::vector<std::uint32_t> original = {};
  FileReport report = {};  ///< what the reader did besides
};

/// Reads the points in `file`; the extension (any case) picks the format. Of a .ply the vertices
/// are taken, whatever else it holds.
///
/// Throws InputError, one line "FILE:LINE: cause" or "FILE: cause", when the file is missing,
/// truncated or malformed, holds a number that is not finite or no point at all, or when the
/// extension is not known; NotBuiltError for a .pcd, which component `pcl` reads.
Points read_points(const std::filesystem::path& file);

/// Writes the points, and their normals if there are any; the extension (any case) picks the
/// format: text, or a binary .ply of doubles. It reads back the same, to the last bit. The file
/// appears whole or not at all.
///
/// Throws UsageError for an unknown extension, a number that is not finite or normals that are
/// neither none nor one a point, NotBuiltError for a .pcd, and Error "cannot write FILE: reason"
/// when the system refuses.
void write_points(const std::filesystem::path& file, const Points& points);

/// The extensions that `write_points` knows.
std::span<const std::string_view> point_output_extensions();

/// Whether `file` is a .ply that has vertices but no faces, strips or edges, as its header says: a
/// cloud. False for anything else, unreadable files too. Cost: reads the header only.
bool is_ply_cloud(const std::filesystem::path& file);

/// The same of bytes; `name` stands for them in messages, and its extension picks the format, or
/// where it is unknown the first bytes do.
Points parse_points(std::string_view bytes, const std::filesystem::path& name);

}  // namespace plexway::io
