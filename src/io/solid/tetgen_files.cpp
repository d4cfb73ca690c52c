// TetGen's .node and .ele, one item a line.
// https://wias-berlin.de/software/tetgen/fformats.html
#include <string>

#include <plexway/error.hpp>
#include <plexway/io/tets.hpp>

#include "io/file_bytes.hpp"
#include "io/names.hpp"
#include "io/readers.hpp"
#include "io/solid/cells.hpp"
#include "io/text_scanner.hpp"

namespace plexway::io {
namespace {

std::uint64_t read_tetgen_count(TextScanner& scanner, std::string_view what) {
  const std::int64_t count = scanner.integer("the number of " + std::string(what));
  if (count < 0)
    scanner.fail("the number of " + std::string(what) + " is negative: " + std::to_string(count));
  return static_cast<std::uint64_t>(count);
}

/// The line starts with the item's own number, which must count on from `first`.
void read_number(TextScanner& scanner, std::string_view item, std::uint64_t i,
                 std::int64_t& first) {
  const std::string what = "the number of the " + std::string(item);
  const std::int64_t number = scanner.integer(what);
  if (i == 0) {
    if (number != 0 && number != 1)
      scanner.fail(what + " is " + std::to_string(number) + "; the first must be 0 or 1");
    first = number;
  }
  const std::int64_t expected = first + static_cast<std::int64_t>(i);
  if (number != expected)
    scanner.fail(what + " is " + std::to_string(number) + ", but it should count on to " +
                 std::to_string(expected));
}

/// Goes to the line of item `i`.
void to_item(TextScanner& scanner, std::string_view items, std::uint64_t i, std::uint64_t count) {
  if (!scanner.to_content())
    scanner.fail("the file ends after " + std::to_string(i) + " of " + std::to_string(count) + " " +
                 std::string(items));
}

/// Refuses a count that the bytes left cannot hold; an item of `solve_each` fields takes two bytes
/// for each, but for the last line's end.
void require_room(TextScanner& scanner, std::string_view items, std::uint64_t count,
                  std::uint64_t fields) {
  if (count >= most_vertices || count > (scanner.bytes_left() + 1) / (2 * fields))
    scanner.fail("there should be " + std::to_string(count) + " " + std::string(items) +
                 ", but only " + std::to_string(scanner.bytes_left()) + " bytes follow");
}

void require_end(TextScanner& scanner, std::string_view items, std::uint64_t count) {
  if (scanner.to_content())
    scanner.fail("the first line says " + std::to_string(count) + " " + std::string(items) +
                 ", but the file goes on with " + quote(scanner.field()));
}

}  // namespace

Tets parse_node_ele(NamedText node, NamedText ele) {
  Tets solid;
  std::int64_t base = 0;

  TextScanner nodes(node.text, node.name);
  if (!nodes.to_content()) nodes.fail("expected the number of vertices, found the end of the file");
  const std::uint64_t vertices = read_tetgen_count(nodes, "vertices");
  if (nodes.to_field()) {  // the other three may be missing
    const std::int64_t dimension = nodes.integer("the dimension");
    if (dimension != 3)
      nodes.fail("the dimension is " + std::to_string(dimension) + "; a solid needs 3");
  }
  require_room(nodes, "vertices", vertices, 4);
  nodes.next_line();
  solid.positions.reserve(vertices);
  for (std::uint64_t i = 0; i < vertices; ++i) {
    to_item(nodes, "vertices", i, vertices);
    read_number(nodes, "vertex", i, base);
    solid.positions.push_back(nodes.position3());
    nodes.next_line();  // attributes, boundary marker
  }
  require_end(nodes, "vertices", vertices);

  TextScanner elements(ele.text, ele.name);
  if (!elements.to_content())
    elements.fail("expected the number of tetrahedra, found the end of the file");
  const std::uint64_t tets = read_tetgen_count(elements, "tetrahedra");
  const std::uint64_t corners =
      elements.to_field() ? read_tetgen_count(elements, "nodes a cell") : 4;
  if (corners != 4 && corners != 10)
    elements.fail("cells have " + std::to_string(corners) +
                  " nodes; a tetrahedron has 4, or 10 when it is quadratic");
  require_room(elements, "tetrahedra", tets, 1 + corners);
  elements.next_line();
  solid.tets.reserve(tets);
  std::int64_t first = 0;
  for (std::uint64_t i = 0; i < tets; ++i) {
    to_item(elements, "tetrahedra", i, tets);
    read_number(elements, "tetrahedron", i, first);
    std::array<std::uint32_t, 4> tet{};
    for (std::uint64_t c = 0; c < corners; ++c) {
      const std::int64_t vertex = elements.integer("a vertex of the tetrahedron");
      if (vertex < base || static_cast<std::uint64_t>(vertex - base) >= vertices)
        elements.fail(
            bad_corner("tetrahedron", first + static_cast<std::int64_t>(i), vertex, vertices) +
            ", numbered from " + std::to_string(base));
      if (c < 4) tet[c] = static_cast<std::uint32_t>(vertex - base);
    }
    solid.tets.push_back(tet);
    elements.next_line();  // attributes
  }
  require_end(elements, "tetrahedra", tets);
  if (solid.tets.empty())
    throw InputError(std::string(ele.name) + ": has no tetrahedra; it has no cells at all");
  return solid;
}

namespace {

namespace fs = std::filesystem;

/// The file beside `file` that makes it whole; its extension may be in capitals.
fs::path partner(fs::path file, std::string_view lower, std::string_view upper) {
  std::error_code ignored;
  const fs::path other = file.replace_extension(lower);
  if (fs::exists(other, ignored)) return other;
  return fs::exists(file.replace_extension(upper), ignored) ? file : other;
}

}  // namespace

Tets read_node_ele(const fs::path& file) {
  const bool is_node = lower_extension(file) == ".node";
  const FileBytes given(file);
  const fs::path other = is_node ? partner(file, ".ele", ".ELE") : partner(file, ".node", ".NODE");
  std::error_code ignored;
  if (!fs::exists(other, ignored))
    throw InputError(file.string() + ": holds only the " +
                     (is_node ? "vertices; the tetrahedra" : "tetrahedra; the vertices") +
                     " must lie beside it in " + other.string());
  const FileBytes second(other);
  const std::string given_name = file.string();
  const std::string other_name = other.string();
  const NamedText a{given.view(), given_name};
  const NamedText b{second.view(), other_name};
  return is_node ? parse_node_ele(a, b) : parse_node_ele(b, a);
}

}  // namespace plexway::io
