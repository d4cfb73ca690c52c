// The vertices with their distances as a binary PLY: `quality` is the name under which mesh viewers
// look for a scalar, the colours are for those that show nothing else.

#include <cmath>
#include <limits>
#include <string>

#include "colour_map.hpp"
#include "field_formats.hpp"

namespace plexway::io {
namespace {

std::size_t count_with(const Field& field, std::size_t corners) {
  std::size_t count = 0;
  for (const Cells& kind : field.cells)
    if (kind.corners == corners) count += kind.count();
  return count;
}

}  // namespace

void write_ply(OutputFile& out, const Field& field) {
  // Most readers expect `int` indices; beyond its range there is only `uint`.
  const bool fits = field.vertices <= std::numeric_limits<std::int32_t>::max();
  const std::string index = fits ? "int" : "uint";
  std::string header =
      "ply\nformat binary_little_endian 1.0\ncomment geodesic distance by plexway\n"
      "element vertex " +
      std::to_string(field.vertices) +
      "\nproperty double x\nproperty double y\nproperty double z\nproperty double quality\n"
      "property uchar red\nproperty uchar green\nproperty uchar blue\n";
  if (!field.label.empty()) header += "property int label\n";
  if (!field.original.empty()) header += "property " + index + " original\n";
  if (!field.error.empty()) header += "property double error\n";
  if (const auto faces = count_with(field, 3); faces != 0)
    header += "element face " + std::to_string(faces) + "\nproperty list uchar " + index +
              " vertex_indices\n";
  if (const auto edges = count_with(field, 2); edges != 0)
    header += "element edge " + std::to_string(edges) + "\nproperty " + index +
              " vertex1\nproperty " + index + " vertex2\n";
  out.write(header + "end_header\n");

  double largest = 0;
  for (const double d : field.distance)
    if (std::isfinite(d) && d > largest) largest = d;
  const ColourMap colour;
  for (std::size_t i = 0; i < field.vertices; ++i) {
    for (const double c : field.positions[i]) out.write_binary(c);
    out.write_binary(field.distance[i]);
    for (const std::uint8_t c : colour(field.distance[i], largest)) out.write_binary(c);
    if (!field.label.empty()) out.write_binary(field.label[i]);
    if (!field.original.empty()) out.write_binary(field.original[i]);
    if (!field.error.empty()) out.write_binary(field.error[i]);
  }
  for (const std::size_t corners : {std::size_t{3}, std::size_t{2}}) {
    for (const Cells& kind : field.cells) {
      if (kind.corners != corners) continue;
      for (std::size_t i = 0; i < kind.connectivity.size(); ++i) {
        if (corners == 3 && i % 3 == 0) out.write_binary(std::uint8_t{3});
        out.write_binary(kind.connectivity[i]);
      }
    }
  }
}

}  // namespace plexway::io
