// Wavefront OBJ. Why no library reads it for us: docs/FORMATS.md.

#include <plexway/io/triangles.hpp>

#include "obj_fields.hpp"
#include "surface_checks.hpp"
#include "text_scanner.hpp"

namespace plexway::io {
namespace {

constexpr std::uint64_t no_limit = most_vertices;

/// Room for as many vertices and faces as there are lines that look like one. Counting lines
/// first costs a few per cent and saves the vectors from growing by copies.
void reserve_by_lines(std::string_view text, Triangles& surface) {
  std::size_t vertices = 0;
  std::size_t faces = 0;
  for (std::size_t at = 0; at + 1 < text.size();) {
    if (text[at + 1] == ' ') {
      if (text[at] == 'v') ++vertices;
      if (text[at] == 'f') ++faces;
    }
    const auto newline = text.find('\n', at);
    if (newline == std::string_view::npos) break;
    at = newline + 1;
  }
  surface.positions.reserve(vertices);
  surface.triangles.reserve(faces);
}

constexpr ObjElement face = {"face", "a vertex of the face"};

/// Reads all statements. A face may name vertices that come later, so `limit` is the number of
/// vertices of the whole file, if known. Returns one more than the highest vertex named.
std::uint64_t read_obj_statements(std::string_view text, std::string_view name, std::uint64_t limit,
                                  Triangles& surface) {
  TextScanner scanner(text, name, TextScanner::Backslash::joins_lines);
  std::uint64_t needed = 0;
  std::size_t faces = 0;
  while (scanner.to_content()) {
    if (scanner.take_letter('v')) {
      read_obj_vertex(scanner, surface.positions);
    } else if (scanner.take_letter('f')) {
      Fan fan(surface);
      while (scanner.to_field()) {
        const auto vertex = read_obj_corner(scanner, face, faces, surface.positions.size(), limit);
        if (vertex >= needed) needed = vertex + 1;
        fan.corner(static_cast<std::uint32_t>(vertex));
      }
      if (fan.corners() < 3) scanner.fail(too_few_corners(faces, fan.corners()));
      ++faces;
    }
    scanner.next_line();
  }
  return needed;
}

}  // namespace

Triangles parse_obj(std::string_view text, std::string_view name) {
  Triangles surface;
  reserve_by_lines(text, surface);
  const std::uint64_t needed = read_obj_statements(text, name, no_limit, surface);
  require_faces(surface, name);
  const std::size_t vertices = surface.positions.size();
  if (needed > vertices) {
    // Some face names a vertex that never came. Only now that is certain; the second reading
    // stops at its line.
    surface = {};
    read_obj_statements(text, name, vertices, surface);
  }
  return surface;
}

}  // namespace plexway::io
