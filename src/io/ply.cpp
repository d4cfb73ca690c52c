// Stanford PLY as a surface: its vertices and faces.

#include <string>

#include <plexway/io/triangles.hpp>

#include "ply_body.hpp"

namespace plexway::io {
namespace {

template <class Source>
void read_corners(Source& source, const PlySurface& layout, std::uint64_t face,
                  Triangles& surface) {
  const PlyProperty& property = *layout.corners;
  const std::uint64_t vertices = layout.vertex.element->count;
  const std::int64_t corners = source.whole(property.count_type, "the number of corners");
  if (corners < 0) source.fail("the number of corners is negative: " + std::to_string(corners));
  if (corners < 3) source.fail(too_few_corners(face, static_cast<std::size_t>(corners)));
  Fan fan(surface);
  for (std::int64_t c = 0; c < corners; ++c) {
    const std::int64_t index = source.whole(property.type, "a vertex of the face");
    if (index < 0 || static_cast<std::uint64_t>(index) >= vertices)
      source.fail(bad_index(face, index, vertices));
    fan.corner(static_cast<std::uint32_t>(index));
  }
}

template <class Source>
Triangles read_body(Source source, const PlyHeader& header, const PlySurface& layout) {
  Triangles surface;
  const auto begin = [&](const PlyElement& element) {
    if (&element == layout.vertex.element) surface.positions.reserve(element.count);
    if (&element == layout.face) surface.triangles.reserve(element.count);
  };
  const auto read = [&](const PlyElement& element, std::uint64_t i, const PlyProperty& property) {
    if (&element == layout.vertex.element) {
      if (&property == &element.properties.front()) surface.positions.push_back({});
      return layout.vertex.take(source, property, surface.positions.back());
    }
    if (&property != layout.corners) return false;
    read_corners(source, layout, i, surface);
    return true;
  };
  walk_ply(source, header, begin, read);
  return surface;
}

}  // namespace

Triangles parse_ply(std::string_view bytes, std::string_view name) {
  const PlyHeader header = parse_ply_header(bytes, name);
  const PlySurface layout(header, name);
  Triangles surface = header.format == PlyFormat::ascii
                          ? read_body(PlyText(bytes, name, header), header, layout)
                          : read_body(PlyBytes(bytes, name, header), header, layout);
  require_faces(surface, name);
  return surface;
}

}  // namespace plexway::io
