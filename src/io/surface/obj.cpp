// Wavefront OBJ: its vertices, faces and lines. Why no library reads it for us:
// docs/reference/formats.md.

#include <algorithm>

#include "io/names.hpp"
#include "io/readers.hpp"
#include "io/solid/cells.hpp"
#include "io/surface/polygons.hpp"
#include "io/text_scanner.hpp"

namespace plexway::io {
namespace {

class ObjReader {
 public:
  ObjReader(std::string_view text, std::string_view name) : text_(text), name_(name) {}

  Mixed read() {
    reserve_by_lines();
    read_statements(most_vertices);
    const std::size_t vertices = cells_.positions.size();
    if (needed_ > vertices) {
      // Some face names a vertex that never came. Only now that is certain; the second reading
      // stops at its line.
      cells_ = {};
      faces_ = lines_ = 0;
      read_statements(vertices);
    }
    cells_.report.split_polygons = polygons_.cut(cells_.positions);
    return std::move(cells_);
  }

 private:
  /// Room for as many vertices and faces as there are lines that look like one. Counting lines
  /// first costs a few per cent and saves the vectors from growing by copies.
  void reserve_by_lines() {
    std::size_t vertices = 0, faces = 0;
    for (std::size_t at = 0; at + 1 < text_.size();) {
      if (text_[at + 1] == ' ') {
        if (text_[at] == 'v') ++vertices;
        if (text_[at] == 'f') ++faces;
      }
      const auto newline = text_.find('\n', at);
      if (newline == std::string_view::npos) break;
      at = newline + 1;
    }
    cells_.positions.reserve(vertices);
    cells_.triangles.reserve(faces);
  }

  /// Reads all statements. They may name vertices that come later, so `limit` is the number of
  /// vertices of the whole file, if known.
  void read_statements(std::uint64_t limit) {
    TextScanner scanner(text_, name_, TextScanner::Backslash::joins_lines);
    while (scanner.to_content()) {
      if (scanner.take_letter('v')) {
        read_vertex(scanner);
      } else if (scanner.take_letter('f')) {
        while (scanner.to_field())
          polygons_.corner(corner(scanner, "face", "a vertex of the face", faces_, limit));
        if (polygons_.corners() < 3) scanner.fail(too_few_corners(faces_, polygons_.corners()));
        polygons_.end_face();
        ++faces_;
      } else if (scanner.take_letter('l')) {
        read_line(scanner, limit);
      }
      scanner.next_line();
    }
  }

  void read_vertex(TextScanner& scanner) {
    const auto position = scanner.position3();
    while (scanner.to_field()) scanner.field();  // weight or colour
    if (cells_.positions.size() == most_vertices) scanner.fail("more vertices than 32 bits count");
    cells_.positions.push_back(position);
  }

  void read_line(TextScanner& scanner, std::uint64_t limit) {
    std::size_t corners = 0;
    std::uint32_t previous = 0;
    for (; scanner.to_field(); ++corners) {
      const std::uint32_t next =
          corner(scanner, "polyline", "a vertex of the polyline", lines_, limit);
      if (corners > 0) cells_.edges.push_back({previous, next});
      previous = next;
    }
    if (corners < 2)
      scanner.fail("polyline " + std::to_string(lines_) + " has " + std::to_string(corners) +
                   (corners == 1 ? " vertex" : " vertices") + "; it needs at least 2");
    ++lines_;
  }

  /// One corner of the element with this number: `v`, `v/vt`, `v//vn` or `v/vt/vn`. Returns the
  /// vertex, 0-based, < `limit`.
  std::uint32_t corner(TextScanner& scanner, std::string_view element, std::string_view what,
                       std::size_t number, std::uint64_t limit) {
    const std::int64_t index = scanner.integer(what, '/');
    const std::string_view rest = scanner.rest_of_field();
    if (rest.find_first_not_of("/-+0123456789") != std::string_view::npos)
      scanner.fail("a corner of the " + std::string(element) +
                   " is not like 1, 1/2, 1//3 or 1/2/3: it goes on with " + quote(rest));
    const auto names = [&] {
      return std::string(element) + " " + std::to_string(number) + " names vertex " +
             std::to_string(index);
    };
    const std::uint64_t so_far = cells_.positions.size();
    if (index == 0) scanner.fail(names() + "; OBJ counts from 1");
    if (index < 0) {
      const auto back = std::uint64_t{0} - static_cast<std::uint64_t>(index);
      if (back > so_far)
        scanner.fail(names() + ", but only " + std::to_string(so_far) + " vertices come before it");
      return static_cast<std::uint32_t>(so_far - back);
    }
    const auto vertex = static_cast<std::uint64_t>(index) - 1;
    if (vertex >= limit)
      scanner.fail(names() + ", but the file has " + std::to_string(limit) + " vertices");
    needed_ = std::max(needed_, vertex + 1);
    return static_cast<std::uint32_t>(vertex);
  }

  std::string_view text_, name_;
  Mixed cells_;
  Faces polygons_{cells_.triangles};
  std::uint64_t needed_ = 0;  ///< one more than the highest vertex named
  std::size_t faces_ = 0, lines_ = 0;
};

}  // namespace

Mixed parse_obj(std::string_view text, std::string_view name) {
  return ObjReader(text, name).read();
}

}  // namespace plexway::io
