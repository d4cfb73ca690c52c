#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string_view>
#include <vector>

#include <plexway/io/file_report.hpp>

namespace plexway::io {

/// A wireframe as a file has it: nothing merged, reordered or dropped.
struct Edges {
  std::vector<std::array<double, 3>> positions;     ///< in file units; empty if the file has none
  std::vector<std::array<std::uint32_t, 2>> edges;  ///< 0-based, each < vertices
  std::vector<double> lengths;                      ///< one an edge; empty: from the positions
  std::size_t vertices = 0;                         ///< referenced or not
  FileReport report = {};                           ///< what the reader did besides
};

/// Reads the wireframe in `file`; the extension (any case) picks the format.
///
/// Throws InputError, one line "FILE:LINE: cause" or "FILE: cause", when the file is missing or
/// malformed, holds a number that is not finite, an index out of range, no edge at all, or when the
/// extension is not known.
Edges read_edges(const std::filesystem::path& file);

/// Writes the wireframe; the extension (any case) picks the format. An .edges holds lengths instead
/// of positions. The file appears whole or not at all. Throws as write_triangles does, and
/// UsageError where a format needs positions and there are none.
void write_edges(const std::filesystem::path& file, const Edges& wireframe);

/// The extensions `write_edges` knows, with the dot, in lower case.
std::span<const std::string_view> edge_output_extensions();

}  // namespace plexway::io
