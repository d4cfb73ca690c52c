// Object File Format, ascii. One vertex and one face a line, as all writers do it: the format
// would let fields flow over lines, but then a missing number silently shifts all that follow.

#include "io/readers.hpp"
#include "io/surface/polygons.hpp"
#include "io/text_scanner.hpp"

namespace plexway::io {
namespace {

/// Accepts OFF and its variants with texture (ST), colour (C) and normal (N) at each vertex; these
/// come after the coordinates, so the variant makes no difference to us.
void check_keyword(TextScanner& scanner, std::string_view keyword) {
  // Some write the number of vertices right behind it.
  const std::size_t end = keyword.find_last_not_of("0123456789") + 1;
  scanner.back(keyword.size() - end);
  std::string_view prefix = keyword.substr(0, end);
  if (prefix == "off") return;
  if (!prefix.ends_with("OFF")) scanner.fail("expected OFF, found " + quote(keyword));
  prefix.remove_suffix(3);
  if (prefix.find_first_of("4n") != std::string_view::npos)
    scanner.fail(quote(keyword) + " is not three-dimensional and is not read");
  if (prefix.starts_with("ST")) prefix.remove_prefix(2);
  if (prefix.find_first_not_of("CN") != std::string_view::npos)
    scanner.fail("expected OFF, found " + quote(keyword));
}

std::uint64_t read_count(TextScanner& scanner, std::string_view what) {
  const std::int64_t count = scanner.integer(what);
  if (count < 0) scanner.fail(std::string(what) + " is negative: " + std::to_string(count));
  return static_cast<std::uint64_t>(count);
}

bool starts_number(char c) { return (c >= '0' && c <= '9') || c == '-' || c == '+'; }

}  // namespace

Triangles parse_off(std::string_view text, std::string_view name) {
  TextScanner scanner(text, name);
  if (!scanner.to_content()) scanner.fail("expected OFF, found the end of the file");
  if (!starts_number(*scanner.position())) {  // the keyword is optional
    check_keyword(scanner, scanner.field());
    if (scanner.to_field() && !starts_number(*scanner.position())) {
      const auto field = scanner.field();
      if (field == "BINARY") scanner.fail("binary OFF is not read; save it as ascii");
      scanner.fail("expected the number of vertices, found " + quote(field));
    }
    if (!scanner.to_content()) scanner.fail("the file ends before the number of vertices");
  }
  const std::uint64_t vertices = read_count(scanner, "the number of vertices");
  const std::uint64_t faces = read_count(scanner, "the number of faces");
  if (scanner.to_field()) scanner.integer("the number of edges");
  if (scanner.to_field())
    scanner.fail("expected three counts, found also " + quote(scanner.field()));

  // "0 0 0\n" and "3 0 0 0\n" are the shortest lines there are; the last needs no line end.
  const std::uint64_t room = scanner.bytes_left();
  if (vertices >= most_vertices || vertices > room / 6 || faces > (room + 1 - vertices * 6) / 8)
    scanner.fail("the header says " + std::to_string(vertices) + " vertices and " +
                 std::to_string(faces) + " faces, but only " + std::to_string(room) +
                 " bytes follow");
  scanner.next_line();

  Triangles surface;
  surface.positions.reserve(vertices);
  surface.triangles.reserve(faces);
  Faces polygons(surface.triangles);
  for (std::uint64_t i = 0; i < vertices; ++i) {
    if (!scanner.to_content())
      scanner.fail("the file ends after " + std::to_string(i) + " of " + std::to_string(vertices) +
                   " vertices");
    surface.positions.push_back(scanner.position3());
    scanner.next_line();  // normals, colours
  }
  for (std::uint64_t i = 0; i < faces; ++i) {
    if (!scanner.to_content())
      scanner.fail("the file ends after " + std::to_string(i) + " of " + std::to_string(faces) +
                   " faces");
    const std::uint64_t corners = read_count(scanner, "the number of corners");
    if (corners < 3) scanner.fail(too_few_corners(i, corners));
    for (std::uint64_t c = 0; c < corners; ++c) {
      const std::int64_t index = scanner.integer("a vertex of the face");
      if (index < 0 || static_cast<std::uint64_t>(index) >= vertices)
        scanner.fail(bad_corner("face", static_cast<std::int64_t>(i), index, vertices));
      polygons.corner(static_cast<std::uint32_t>(index));
    }
    polygons.end_face();
    scanner.next_line();  // colours
  }
  surface.report.split_polygons = polygons.cut(surface.positions);
  if (scanner.to_content())
    scanner.fail("the header says " + std::to_string(faces) + " faces, but the file goes on with " +
                 quote(scanner.field()));
  require_faces(surface, name);
  return surface;
}

}  // namespace plexway::io
