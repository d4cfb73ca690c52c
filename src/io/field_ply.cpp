// The surface with its distances as a binary PLY: `quality` is the name under which mesh viewers
// look for a scalar, the colours are for those that show nothing else.

#include <limits>
#include <string>

#include "colour_map.hpp"
#include "field_formats.hpp"

namespace plexway::io {

void write_ply(OutputFile& out, const Field& field) {
  const auto& [positions, triangles] = field.surface;
  // Most readers expect `int` indices; beyond its range there is only `uint`.
  const bool fits = positions.size() <= std::numeric_limits<std::int32_t>::max();
  std::string header =
      "ply\nformat binary_little_endian 1.0\ncomment geodesic distance by plexway\n"
      "element vertex " +
      std::to_string(positions.size()) +
      "\nproperty double x\nproperty double y\nproperty double z\nproperty double quality\n"
      "property uchar red\nproperty uchar green\nproperty uchar blue\n";
  if (!field.label.empty()) header += "property int label\n";
  header += "element face " + std::to_string(triangles.size()) + "\nproperty list uchar " +
            (fits ? "int" : "uint") + " vertex_indices\nend_header\n";
  out.write(header);

  double largest = 0;
  for (const double d : field.distance)
    if (std::isfinite(d) && d > largest) largest = d;
  const ColourMap colour;
  for (std::size_t i = 0; i < positions.size(); ++i) {
    for (const double c : positions[i]) out.write_binary(c);
    out.write_binary(field.distance[i]);
    for (const std::uint8_t c : colour(field.distance[i], largest)) out.write_binary(c);
    if (!field.label.empty()) out.write_binary(field.label[i]);
  }
  for (const auto& triangle : triangles) {
    out.write_binary(std::uint8_t{3});
    for (const std::uint32_t vertex : triangle) out.write_binary(vertex);
  }
}

}  // namespace plexway::io
