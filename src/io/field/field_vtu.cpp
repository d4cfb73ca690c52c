// VTK's XML unstructured grid with raw appended data: the XML names each array and where its bytes
// lie behind the '_' of <AppendedData>; each block of bytes starts with its length (UInt64).

#include <string>

#include "field_formats.hpp"

namespace plexway::io {
namespace {

/// Hands out offsets in the order in which the blocks are written.
class Blocks {
 public:
  std::string array(std::string_view type, std::string_view name, std::uint64_t components,
                    std::uint64_t bytes) {
    std::string tag =
        "        <DataArray type=\"" + std::string(type) + "\" Name=\"" + std::string(name) + "\"";
    // VTK takes a missing count for 1, and some readers take "1" for a second axis.
    if (components > 1) tag += " NumberOfComponents=\"" + std::to_string(components) + "\"";
    tag += " format=\"appended\" offset=\"" + std::to_string(offset_) + "\"/>\n";
    offset_ += sizeof(std::uint64_t) + bytes;
    return tag;
  }

 private:
  std::uint64_t offset_ = 0;
};

}  // namespace

void write_vtu(OutputFile& out, const Field& field) {
  const std::uint64_t vertices = field.vertices;
  const std::uint64_t cells = field.cell_count();
  const std::uint64_t corners = field.corner_count();
  const bool distances = !field.distance.empty();
  const bool labels = !field.label.empty();
  const bool originals = distances && !field.original.empty();
  const bool errors = distances && !field.error.empty();

  Blocks blocks;
  std::string xml =
      "<?xml version=\"1.0\"?>\n"
      "<VTKFile type=\"UnstructuredGrid\" version=\"1.0\" byte_order=\"LittleEndian\" "
      "header_type=\"UInt64\">\n"
      "  <UnstructuredGrid>\n"
      "    <Piece NumberOfPoints=\"" +
      std::to_string(vertices) + "\" NumberOfCells=\"" + std::to_string(cells) + "\">\n";
  if (distances) {
    xml += "      <PointData Scalars=\"distance\">\n";
    xml += blocks.array("Float64", "distance", 1, 8 * vertices);
    if (labels) xml += blocks.array("Int32", "label", 1, 4 * vertices);
    if (originals) xml += blocks.array("UInt32", "original", 1, 4 * vertices);
    if (errors) xml += blocks.array("Float64", "error", 1, 8 * vertices);
    xml += "      </PointData>\n";
  }
  xml += "      <Points>\n";
  xml += blocks.array("Float64", "Points", 3, 24 * vertices);
  xml += "      </Points>\n      <Cells>\n";
  xml += blocks.array("Int64", "connectivity", 1, 8 * corners);
  xml += blocks.array("Int64", "offsets", 1, 8 * cells);
  xml += blocks.array("UInt8", "types", 1, cells);
  xml +=
      "      </Cells>\n    </Piece>\n  </UnstructuredGrid>\n  <AppendedData encoding=\"raw\">\n_";
  out.write(xml);

  if (distances) {
    out.write_binary(8 * vertices);
    for (const double d : field.distance) out.write_binary(d);
  }
  if (labels) {
    out.write_binary(4 * vertices);
    for (const std::int32_t l : field.label) out.write_binary(l);
  }
  if (originals) {
    out.write_binary(4 * vertices);
    for (const std::uint32_t i : field.original) out.write_binary(i);
  }
  if (errors) {
    out.write_binary(8 * vertices);
    for (const double e : field.error) out.write_binary(e);
  }
  out.write_binary(24 * vertices);
  for (const auto& position : field.positions)
    for (const double c : position) out.write_binary(c);
  out.write_binary(8 * corners);
  for (const Cells& kind : field.cells)
    for (const std::uint32_t vertex : kind.connectivity) out.write_binary(std::int64_t{vertex});
  out.write_binary(8 * cells);
  std::int64_t end = 0;
  for (const Cells& kind : field.cells)
    for (std::size_t c = 0; c < kind.count(); ++c)
      out.write_binary(end += static_cast<std::int64_t>(kind.corners));
  out.write_binary(cells);
  for (const Cells& kind : field.cells)
    for (std::size_t c = 0; c < kind.count(); ++c) out.write_binary(kind.vtk_type);
  out.write("\n  </AppendedData>\n</VTKFile>\n");
}

}  // namespace plexway::io
