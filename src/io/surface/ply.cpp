// Stanford PLY: its vertices, faces, triangle strips and edges.

#include <optional>
#include <string>

#include <plexway/io/triangles.hpp>

#include "io/readers.hpp"
#include "io/solid/cells.hpp"
#include "io/surface/ply_body.hpp"
#include "io/surface/polygons.hpp"
#include "io/text_scanner.hpp"

namespace plexway::io {

namespace {

std::optional<PlyType> type_named(std::string_view word) {
  if (word == "char" || word == "int8") return PlyType::i8;
  if (word == "uchar" || word == "uint8") return PlyType::u8;
  if (word == "short" || word == "int16") return PlyType::i16;
  if (word == "ushort" || word == "uint16") return PlyType::u16;
  if (word == "int" || word == "int32") return PlyType::i32;
  if (word == "uint" || word == "uint32") return PlyType::u32;
  if (word == "float" || word == "float32") return PlyType::f32;
  if (word == "double" || word == "float64") return PlyType::f64;
  return std::nullopt;
}

PlyType read_type(TextScanner& scanner) {
  const auto word = scanner.field();
  const auto type = type_named(word);
  if (!type) scanner.fail("unknown property type " + quote(word));
  return *type;
}

PlyFormat read_format(TextScanner& scanner) {
  const auto word = scanner.field();
  PlyFormat format = PlyFormat::ascii;
  if (word == "binary_little_endian")
    format = PlyFormat::little_endian;
  else if (word == "binary_big_endian")
    format = PlyFormat::big_endian;
  else if (word != "ascii")
    scanner.fail("unknown format " + quote(word));
  const auto version = scanner.field();
  if (version != "1.0") scanner.fail("unknown version " + quote(version) + "; 1.0 is read");
  return format;
}

PlyElement read_element(TextScanner& scanner, const std::vector<PlyElement>& before) {
  PlyElement element;
  element.name = scanner.field();
  element.line = scanner.line();
  for (const auto& other : before)
    if (other.name == element.name) scanner.fail("a second element " + quote(element.name));
  const std::int64_t count = scanner.integer("the number of " + quote(element.name) + " elements");
  if (count < 0)
    scanner.fail("the number of " + quote(element.name) +
                 " elements is negative: " + std::to_string(count));
  element.count = static_cast<std::uint64_t>(count);
  return element;
}

PlyProperty read_property(TextScanner& scanner, const PlyElement& element) {
  PlyProperty property{};
  const auto word = scanner.field();
  if (word == "list") {
    property.is_list = true;
    property.count_type = read_type(scanner);
    if (is_float(property.count_type)) scanner.fail("a list's length must be of a whole type");
    property.type = read_type(scanner);
  } else {
    const auto type = type_named(word);
    if (!type) scanner.fail("unknown property type " + quote(word));
    property.type = *type;
  }
  property.name = scanner.field();
  if (property.name.empty()) scanner.fail("a property without a name");
  for (const auto& other : element.properties)
    if (other.name == property.name) scanner.fail("a second property " + quote(property.name));
  return property;
}

}  // namespace

PlyHeader parse_ply_header(std::string_view bytes, std::string_view name) {
  TextScanner scanner(bytes, name);
  PlyHeader header;
  if (const auto word = scanner.field(); word != "ply")
    scanner.fail("expected 'ply', found " + quote(word));
  bool has_format = false;
  while (scanner.next_line()) {
    const auto word = scanner.field();
    if (word == "end_header") {
      if (!has_format) scanner.fail("the header has no format line");
      if (!scanner.next_line()) scanner.fail("the file ends with its header");
      header.size = static_cast<std::size_t>(scanner.position() - bytes.data());
      header.lines = scanner.line() - 1;
      return header;
    }
    if (word == "format") {
      header.format = read_format(scanner);
      has_format = true;
    } else if (word == "element") {
      header.elements.push_back(read_element(scanner, header.elements));
    } else if (word == "property") {
      if (header.elements.empty()) scanner.fail("a property before the first element");
      auto& element = header.elements.back();
      element.properties.push_back(read_property(scanner, element));
    } else if (!word.empty() && word != "comment" && word != "obj_info") {
      scanner.fail("unknown word " + quote(word) + " in the header");
    }
  }
  scanner.fail("the file ends before 'end_header'");
}

namespace {

/// What the header has of each kind.
struct Layout {
  PlyVertex vertex;
  PlyCorners face, strips;
  const PlyElement* edge = nullptr;
  std::array<const PlyProperty*, 2> ends{};

  Layout(const PlyHeader& header, std::string_view name)
      : vertex(header, name), face(header, "face", name), strips(header, "tristrips", name) {
    for (const auto& element : header.elements)
      if (element.name == "edge") edge = &element;
    for (std::size_t k = 0; k < 2 && edge != nullptr; ++k) {
      ends[k] = find_property(*edge, k == 0 ? "vertex1" : "vertex2");
      if (ends[k] == nullptr || ends[k]->is_list) edge = nullptr;  // not as others write them
    }
  }
};

template <class Source>
class PlyReader {
 public:
  PlyReader(Source source, const Layout& layout) : source_(source), layout_(layout) {}

  Mixed read(const PlyHeader& header) {
    const auto begin = [&](const PlyElement& element) {
      if (&element == layout_.vertex.element) cells_.positions.reserve(element.count);
      if (&element == layout_.face.element) cells_.triangles.reserve(element.count);
    };
    const auto read = [&](const PlyElement& element, std::uint64_t i, const PlyProperty& property) {
      if (&element == layout_.vertex.element) {
        if (&property == &element.properties.front()) cells_.positions.push_back({});
        return layout_.vertex.take(source_, property, cells_.positions.back());
      }
      if (&property == layout_.face.list) return read_face(property, i);
      if (&property == layout_.strips.list) return read_strips(property, i);
      if (&element == layout_.edge &&
          (&property == layout_.ends[0] || &property == layout_.ends[1]))
        return read_end(property, i);
      return false;
    };
    walk_ply(source_, header, begin, read);
    cells_.report.split_polygons = polygons_.cut(cells_.positions);
    return std::move(cells_);
  }

 private:
  std::uint64_t length(const PlyProperty& property) {
    const std::int64_t corners = source_.whole(property.count_type, "the number of corners");
    if (corners < 0) source_.fail("the number of corners is negative: " + std::to_string(corners));
    return static_cast<std::uint64_t>(corners);
  }
  std::uint32_t vertex(std::int64_t index, std::string_view element, std::uint64_t number) {
    const std::uint64_t vertices = layout_.vertex.element->count;
    if (index < 0 || static_cast<std::uint64_t>(index) >= vertices)
      source_.fail(bad_corner(element, static_cast<std::int64_t>(number), index, vertices));
    return static_cast<std::uint32_t>(index);
  }

  bool read_face(const PlyProperty& property, std::uint64_t face) {
    const std::uint64_t corners = length(property);
    if (corners < 3) source_.fail(too_few_corners(face, corners));
    for (std::uint64_t c = 0; c < corners; ++c)
      polygons_.corner(vertex(source_.whole(property.type, "a vertex of the face"), "face", face));
    polygons_.end_face();
    return true;
  }
  // One list may hold several strips, with -1 between them.
  bool read_strips(const PlyProperty& property, std::uint64_t number) {
    std::vector<std::uint32_t> strip;
    CellTaker taker(cells_);
    for (std::uint64_t left = length(property); left > 0; --left) {
      const std::int64_t index = source_.whole(property.type, "a vertex of the strip");
      if (index != -1) strip.push_back(vertex(index, "strip", number));
      if (index != -1 && left > 1) continue;
      static_cast<void>(taker.add(CellKind::strip, strip));
      strip.clear();
    }
    return true;
  }
  bool read_end(const PlyProperty& property, std::uint64_t edge) {
    if (cells_.edges.size() <= edge) cells_.edges.push_back({});
    cells_.edges.back()[&property == layout_.ends[0] ? 0 : 1] =
        vertex(source_.whole(property.type, "a vertex of the edge"), "edge", edge);
    return true;
  }

  Source source_;
  const Layout& layout_;
  Mixed cells_;
  Faces polygons_{cells_.triangles};
};

}  // namespace

Mixed parse_ply(std::string_view bytes, std::string_view name) {
  const PlyHeader header = parse_ply_header(bytes, name);
  const Layout layout(header, name);
  return header.format == PlyFormat::ascii
             ? PlyReader(PlyText(bytes, name, header), layout).read(header)
             : PlyReader(PlyBytes(bytes, name, header), layout).read(header);
}

}  // namespace plexway::io
