// Wavefront OBJ as a wireframe: its `l` statements.

#include <plexway/io/edges.hpp>

#include "obj_fields.hpp"
#include "text_scanner.hpp"

namespace plexway::io {
namespace {

constexpr ObjElement polyline = {"polyline", "a vertex of the polyline"};

struct Named {
  std::uint64_t vertices = 0;  ///< one more than the highest vertex named
  bool faces = false;          ///< the file has some
};

/// A polyline may name vertices that come later, so `limit` is the number of vertices of the whole
/// file, if known.
Named read_statements(std::string_view text, std::string_view name, std::uint64_t limit,
                      Edges& wires) {
  TextScanner scanner(text, name, TextScanner::Backslash::joins_lines);
  Named named;
  std::size_t polylines = 0;
  while (scanner.to_content()) {
    if (scanner.take_letter('v')) {
      read_obj_vertex(scanner, wires.positions);
    } else if (scanner.take_letter('l')) {
      std::size_t corners = 0;
      std::uint32_t previous = 0;
      for (; scanner.to_field(); ++corners) {
        const auto vertex =
            read_obj_corner(scanner, polyline, polylines, wires.positions.size(), limit);
        if (vertex >= named.vertices) named.vertices = vertex + 1;
        const auto corner = static_cast<std::uint32_t>(vertex);
        if (corners > 0) wires.edges.push_back({previous, corner});
        previous = corner;
      }
      if (corners < 2)
        scanner.fail("polyline " + std::to_string(polylines) + " has " + std::to_string(corners) +
                     (corners == 1 ? " vertex" : " vertices") + "; it needs at least 2");
      ++polylines;
    } else if (scanner.take_letter('f')) {
      named.faces = true;
    }
    scanner.next_line();
  }
  return named;
}

}  // namespace

Edges parse_obj_lines(std::string_view text, std::string_view name) {
  Edges wires;
  const Named named = read_statements(text, name, most_vertices, wires);
  if (wires.edges.empty())
    throw InputError(std::string(name) + (named.faces
                                              ? ": has faces but no lines; read it as a surface"
                                              : ": has no lines; a wireframe needs at least one"));
  wires.vertices = wires.positions.size();
  if (named.vertices > wires.vertices) {
    // Some polyline names a vertex that never came; the second reading stops at its line.
    const std::size_t vertices = wires.vertices;
    wires = {};
    read_statements(text, name, vertices, wires);
  }
  return wires;
}

}  // namespace plexway::io
