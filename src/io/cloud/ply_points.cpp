// Stanford PLY as a cloud: its vertices alone.

#include <string>

#include "io/file_bytes.hpp"
#include "io/names.hpp"
#include "io/readers.hpp"
#include "io/surface/ply_body.hpp"

namespace plexway::io {
namespace {

/// The vertices' normals where all three numbers are there.
PlyTriple normals_of(const PlyElement& vertex) {
  static constexpr std::string_view names[3] = {"the normal's nx", "the normal's ny",
                                                "the normal's nz"};
  PlyTriple normals{{}, names};
  for (std::size_t k = 0; k < 3; ++k) {
    normals.axes[k] = find_property(vertex, names[k].substr(13));
    if (normals.axes[k] == nullptr || normals.axes[k]->is_list) return {};
  }
  return normals;
}

template <class Source>
Points read_point_body(Source source, const PlyHeader& header, const PlyVertex& vertex) {
  const PlyTriple normals = normals_of(*vertex.element);
  const bool normal = normals.axes[0] != nullptr;
  Points points;
  const auto begin = [&](const PlyElement& element) {
    if (&element != vertex.element) return;
    points.positions.reserve(element.count);
    if (normal) points.normals.reserve(element.count);
  };
  const auto read = [&](const PlyElement& element, std::uint64_t, const PlyProperty& property) {
    if (&element != vertex.element) return false;
    if (&property == &element.properties.front()) {
      points.positions.push_back({});
      if (normal) points.normals.push_back({});
    }
    return vertex.take(source, property, points.positions.back()) ||
           (normal && normals.take(source, property, points.normals.back()));
  };
  walk_ply(source, header, begin, read);
  return points;
}

}  // namespace

Points parse_ply_points(std::string_view bytes, std::string_view name) {
  const PlyHeader header = parse_ply_header(bytes, name);
  const PlyVertex vertex(header, name);
  Points points = header.format == PlyFormat::ascii
                      ? read_point_body(PlyText(bytes, name, header), header, vertex)
                      : read_point_body(PlyBytes(bytes, name, header), header, vertex);
  if (points.positions.empty())
    throw InputError(std::string(name) + ": has no vertices; a cloud needs at least one point");
  return points;
}

bool is_ply_cloud(const std::filesystem::path& file) {
  if (InputName(file).extension != ".ply") return false;
  std::string start;
  try {
    constexpr std::size_t most = 1
                                 << 14;  // longer than any header but those with a page of comments
    start = FileBytes(file, most).view().substr(0, most);
  } catch (const InputError&) {
    return false;  // who reads it will say what is wrong
  }
  // A header that ends with the file is fine here: there is no data to look at.
  if (const auto end = start.find("end_header"); end != start.npos) start.resize(end + 10);
  start += '\n';
  try {
    bool vertices = false;
    for (const PlyElement& element : parse_ply_header(start, "").elements) {
      for (const std::string_view cells : {"face", "tristrips", "edge"})
        if (element.name == cells && element.count != 0) return false;
      if (element.name == "vertex" && element.count != 0) vertices = true;
    }
    return vertices;
  } catch (const InputError&) {
    return false;  // who reads it will say what is wrong
  }
}

}  // namespace plexway::io
