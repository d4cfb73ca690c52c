// Stanford PLY: its vertices, faces, triangle strips and edges.

#include <string>

#include <plexway/io/triangles.hpp>

#include "io/readers.hpp"
#include "io/solid/cells.hpp"
#include "io/surface/ply_body.hpp"
#include "io/surface/polygons.hpp"

namespace plexway::io {
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
