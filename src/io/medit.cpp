// MEDIT's .mesh, ascii: keywords, each with a count and as many items. Lines make no difference.
// P. Frey, "MEDIT: An interactive mesh visualization software", INRIA RT-0253, 2001; libMeshb.

#include <optional>
#include <string>

#include <plexway/io/tets.hpp>

#include "tet_checks.hpp"
#include "value_source.hpp"

namespace plexway::io {
namespace {

struct Section {
  std::string_view keyword;
  std::uint64_t fields;   ///< numbers an item, in three dimensions, the reference included
  std::string_view cell;  ///< what to call it where there are no tetrahedra
};

constexpr Section sections[] = {
    {"Edges", 3, "edges"},
    {"EdgesP2", 4, "edges"},
    {"Triangles", 4, "triangles"},
    {"TrianglesP2", 7, "triangles"},
    {"Quadrilaterals", 5, "quadrilaterals"},
    {"QuadrilateralsQ2", 10, "quadrilaterals"},
    {"Hexahedra", 9, "hexahedra"},
    {"HexahedraQ2", 28, "hexahedra"},
    {"Prisms", 7, "prisms"},
    {"Pentahedra", 7, "prisms"},
    {"PrismsP2", 19, "prisms"},
    {"Pyramids", 6, "pyramids"},
    {"PyramidsP2", 15, "pyramids"},
    {"Corners", 1, ""},
    {"Ridges", 1, ""},
    {"RequiredVertices", 1, ""},
    {"RequiredEdges", 1, ""},
    {"RequiredTriangles", 1, ""},
    {"RequiredQuadrilaterals", 1, ""},
    {"Normals", 3, ""},
    {"NormalAtVertices", 2, ""},
    {"NormalAtTriangleVertices", 3, ""},
    {"NormalAtQuadrilateralVertices", 3, ""},
    {"Tangents", 3, ""},
    {"TangentAtVertices", 2, ""},
    {"TangentAtEdges", 3, ""},
};

const Section* find_section(std::string_view keyword) {
  for (const Section& section : sections)
    if (section.keyword == keyword) return &section;
  return nullptr;
}

/// A section of tetrahedra. What it says can be checked only when the vertices are known, and these
/// may come later, so its place is remembered.
struct TetSection {
  TextValues at;
  std::uint64_t count;
  std::uint64_t corners;
};

class Medit {
 public:
  Medit(std::string_view text, std::string_view name)
      : name_(name), scanner_(text, name), in_(scanner_) {}

  Tets read() {
    std::string_view keyword = in_.word();
    if (keyword != "MeshVersionFormatted")
      in_.fail("expected MeshVersionFormatted, found " + quote(keyword));
    in_.skip(NumberType::i32, 1, "the version");
    for (keyword = in_.word(); !keyword.empty() && keyword != "End";) keyword = section(keyword);
    if (!has_vertices_) in_.fail("the file ends without a section Vertices");
    for (TetSection& tets : tets_) read_tets(tets);
    require_tets(solid_, others_, name_);
    return std::move(solid_);
  }

 private:
  /// Reads or skips one section; the keyword of the next, empty at the end of the file.
  std::string_view section(std::string_view keyword) {
    if (keyword == "Dimension") {
      const std::int64_t dimension = in_.text_whole("the dimension");
      if (dimension != 3)
        in_.fail("the dimension is " + std::to_string(dimension) + "; a solid needs 3");
    } else if (keyword == "Vertices") {
      read_vertices();
    } else if (keyword == "Tetrahedra" || keyword == "TetrahedraP2") {
      const std::uint64_t corners = keyword == "Tetrahedra" ? 4 : 10;
      const std::uint64_t count = read_count("tetrahedra", corners + 1);
      tets_.push_back({in_, count, corners});
      in_.skip(NumberType::i32, count * (corners + 1), "the last of the tetrahedra");
    } else if (const Section* known = find_section(keyword); known != nullptr) {
      const std::string what(keyword);
      const std::uint64_t count = read_count(what, known->fields);
      in_.skip(NumberType::f64, count * known->fields, "the last of the " + what);
      if (!known->cell.empty()) others_.add(known->cell, count);
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
    const std::uint64_t count = read_count("vertices", 4);
    if (count >= most_vertices) in_.fail("more vertices than 32 bits count");
    solid_.positions.reserve(count);
    for (std::uint64_t i = 0; i < count; ++i) {
      std::array<double, 3> position{};
      for (std::size_t k = 0; k < 3; ++k) position[k] = in_.real(NumberType::f64, axis_names[k]);
      solid_.positions.push_back(position);
      in_.whole(NumberType::i32, "the vertex's reference");
    }
  }

  void read_tets(TetSection& section) {
    TextValues& in = section.at;
    solid_.tets.reserve(solid_.tets.size() + section.count);
    for (std::uint64_t i = 0; i < section.count; ++i) {
      std::array<std::uint32_t, 4> tet{};
      for (std::uint64_t c = 0; c < section.corners; ++c) {
        const std::int64_t vertex = in.whole(NumberType::i64, "a vertex of the tetrahedron");
        if (vertex < 1 || static_cast<std::uint64_t>(vertex) > solid_.positions.size())
          in.fail(bad_corner(static_cast<std::int64_t>(i) + 1, vertex, solid_.positions.size()));
        if (c < 4) tet[c] = static_cast<std::uint32_t>(vertex - 1);
      }
      solid_.tets.push_back(tet);
      in.whole(NumberType::i32, "the tetrahedron's reference");
    }
  }

  std::string_view name_;
  TextScanner scanner_;
  TextValues in_;
  Tets solid_;
  bool has_vertices_ = false;
  std::vector<TetSection> tets_;
  OtherCells others_;
};

}  // namespace

Tets parse_medit(std::string_view text, std::string_view name) { return Medit(text, name).read(); }

}  // namespace plexway::io
