// MEDIT's .mesh, ascii: keywords, each with a count and as many items. Lines make no difference.
// P. Frey, "MEDIT: An interactive mesh visualization software", INRIA RT-0253, 2001; libMeshb.

#include <string>

#include <plexway/io/tets.hpp>

#include "io/field/value_source.hpp"
#include "io/readers.hpp"
#include "io/solid/cells.hpp"

namespace plexway::io {
namespace {

/// A section of cells. All others are passed over: marks of vertices and edges, normals, tangents.
struct Section {
  std::string_view keyword;
  std::uint64_t numbers;  ///< a cell, without the reference behind it
  CellKind kind;
};

constexpr Section sections[] = {
    {"Edges", 2, CellKind::line},
    {"EdgesP2", 3, CellKind::line},
    {"Triangles", 3, CellKind::triangle},
    {"TrianglesP2", 6, CellKind::triangle},
    {"Quadrilaterals", 4, CellKind::quad},
    {"QuadrilateralsQ2", 9, CellKind::quad},
    {"Tetrahedra", 4, CellKind::tetrahedron},
    {"TetrahedraP2", 10, CellKind::tetrahedron},
    {"Hexahedra", 8, CellKind::hexahedron},
    {"HexahedraQ2", 27, CellKind::hexahedron},
    {"Prisms", 6, CellKind::prism},
    {"Pentahedra", 6, CellKind::prism},
    {"PrismsP2", 18, CellKind::prism},
    {"Pyramids", 5, CellKind::pyramid},
    {"PyramidsP2", 14, CellKind::pyramid},
};

const Section* find_section(std::string_view keyword) {
  for (const Section& section : sections)
    if (section.keyword == keyword) return &section;
  return nullptr;
}

/// A section of cells. What it says can be checked only when the vertices are known, and these may
/// come later, so its place is remembered.
struct CellSection {
  TextValues at;
  std::uint64_t count;
  const Section& section;
};

class Medit {
 public:
  Medit(std::string_view text, std::string_view name) : name_(name), in_(TextScanner(text, name)) {}

  Mixed read() {
    std::string_view keyword = in_.word();
    if (keyword != "MeshVersionFormatted")
      in_.fail("expected MeshVersionFormatted, found " + quote(keyword));
    in_.skip(NumberType::i32, 1, "the version");
    for (keyword = in_.word(); !keyword.empty() && keyword != "End";) keyword = section(keyword);
    if (!has_vertices_) in_.fail("the file ends without a section Vertices");
    for (CellSection& cells : cell_sections_) read_cells(cells);
    taker_.finish(name_);
    return std::move(cells_);
  }

 private:
  /// Reads or skips one section; the keyword of the next, empty at the end of the file.
  std::string_view section(std::string_view keyword) {
    if (keyword == "Dimension") {
      dimension_ = in_.text_whole("the dimension");
      if (dimension_ != 2 && dimension_ != 3)
        in_.fail("the dimension is " + std::to_string(dimension_) + "; 2 and 3 are read");
    } else if (keyword == "Vertices") {
      read_vertices();
    } else if (const Section* known = find_section(keyword); known != nullptr) {
      const std::uint64_t numbers = known->numbers + 1;
      const std::uint64_t count = read_count(keyword, numbers);
      cell_sections_.push_back({in_, count, *known});
      in_.skip(NumberType::f64, count * numbers, "the last of the " + std::string(keyword));
    } else if (keyword == "Geometry" || keyword == "Identifier") {
      in_.word();
      in_.end_line();  // a name in quotes
    } else if (TextValues::is_word(keyword)) {
      // All that an unknown section can hold is numbers.
      for (keyword = in_.word(); !keyword.empty() && !TextValues::is_word(keyword);)
        keyword = in_.word();
      return keyword;
    } else {
      in_.fail("expected a keyword, found " + quote(keyword) +
               "; the section before it holds more than its count says");
    }
    return in_.word();
  }

  std::uint64_t read_count(std::string_view items, std::uint64_t fields) {
    return checked_count(in_, in_.text_whole("the number of " + std::string(items)), items,
                         NumberType::f64, fields);
  }

  void read_vertices() {
    if (has_vertices_) in_.fail("a second section Vertices");
    has_vertices_ = true;
    const auto axes = static_cast<std::size_t>(dimension_);
    const std::uint64_t count = read_count("vertices", axes + 1);
    if (count >= most_vertices) in_.fail("more vertices than 32 bits count");
    cells_.positions.reserve(count);
    for (std::uint64_t i = 0; i < count; ++i) {
      std::array<double, 3> position{};
      for (std::size_t k = 0; k < axes; ++k) position[k] = in_.real(NumberType::f64, axis_names[k]);
      cells_.positions.push_back(position);
      in_.whole(NumberType::i32, "the vertex's reference");
    }
  }

  void read_cells(CellSection& from) {
    TextValues& in = from.at;
    const CellKind kind = from.section.kind;
    const std::string name(name_of(kind)), vertex_name = "a vertex of the " + name,
                                           reference = "the " + name + "'s reference";
    std::array<std::uint32_t, 27> corner{};
    for (std::uint64_t i = 0; i < from.count; ++i) {
      for (std::uint64_t c = 0; c < from.section.numbers; ++c) {
        const std::int64_t vertex = in.whole(NumberType::i64, vertex_name);
        if (vertex < 1 || static_cast<std::uint64_t>(vertex) > cells_.positions.size())
          in.fail(
              bad_corner(name, static_cast<std::int64_t>(i) + 1, vertex, cells_.positions.size()));
        corner[c] = static_cast<std::uint32_t>(vertex - 1);
      }
      static_cast<void>(taker_.add(kind, std::span(corner).first(from.section.numbers)));
      in.whole(NumberType::i32, reference);
    }
  }

  std::string_view name_;
  TextValues in_;
  Mixed cells_;
  CellTaker taker_{cells_};
  std::int64_t dimension_ = 3;
  bool has_vertices_ = false;
  std::vector<CellSection> cell_sections_;
};

}  // namespace

Mixed parse_medit(std::string_view text, std::string_view name) { return Medit(text, name).read(); }

}  // namespace plexway::io
