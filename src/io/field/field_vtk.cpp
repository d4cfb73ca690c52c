// VTK's files: the legacy format, the XML unstructured grid, and the latter in parts.

#include <array>
#include <cstdint>
#include <functional>
#include <limits>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include <plexway/error.hpp>

#include "io/field/field_formats.hpp"
#include "io/names.hpp"

namespace plexway::io {

// Binary, so big endian. Version 3.0, because older programs stop at what version 5 changed: its
// indices have 32 bits.
void write_vtk(OutputFile& out, const Field& field) {
  constexpr std::size_t most = std::numeric_limits<std::int32_t>::max();
  const std::size_t cells = field.cell_count();
  if (field.vertices > most || cells + field.corner_count() > most)
    throw Error("a legacy .vtk counts with 31 bits, which is too few here; write a .vtu");

  const auto count = [](std::size_t n) { return std::to_string(n); };
  out.write("# vtk DataFile Version 3.0\nwritten by plexway\nBINARY\nDATASET UNSTRUCTURED_GRID\n");
  out.write("POINTS " + count(field.vertices) + " double\n");
  for (const auto& position : field.positions)
    for (const double c : position) out.write_big_endian(c);
  out.write("\nCELLS " + count(cells) + " " + count(cells + field.corner_count()) + "\n");
  for (const Cells& kind : field.cells) {
    for (std::size_t i = 0; i < kind.connectivity.size(); ++i) {
      if (i % kind.corners == 0) out.write_big_endian(static_cast<std::uint32_t>(kind.corners));
      out.write_big_endian(kind.connectivity[i]);
    }
  }
  out.write("\nCELL_TYPES " + count(cells) + "\n");
  for (const Cells& kind : field.cells)
    for (std::size_t c = 0; c < kind.count(); ++c)
      out.write_big_endian(std::uint32_t{kind.vtk_type()});
  if (!field.distance.empty()) {
    out.write("\nPOINT_DATA " + count(field.vertices) +
              "\nSCALARS distance double 1\nLOOKUP_TABLE default\n");
    for (const double d : field.distance) out.write_big_endian(d);
  }
  // Of several SCALARS many readers take the first alone.
  int more = 0;
  field.each_more([&](const char*, auto) { ++more; });
  if (more > 0) out.write("\nFIELD FieldData " + std::to_string(more));
  field.each_more([&]<class Numbers>(const std::string& name, Numbers numbers) {
    using Number = typename Numbers::value_type;
    out.write("\n" + name + " 1 " + count(field.vertices) +
              (std::is_same_v<Number, double> ? " double\n"
               : std::is_signed_v<Number>     ? " int\n"
                                              : " unsigned_int\n"));
    for (const Number number : numbers) out.write_big_endian(number);
  });
  out.write("\n");
}

namespace {

template <class Number>
constexpr const char* xml_type() {
  return std::is_same_v<Number, double> ? "Float64" : std::is_signed_v<Number> ? "Int32" : "UInt32";
}

// With raw appended data: the XML names each array and where its bytes lie behind the '_' of
// <AppendedData>; each block of bytes starts with its length (UInt64).
class Blocks {
 public:
  // Hands out offsets in the order in which the blocks are written.
  std::string array(std::string_view type, std::string_view name, std::uint64_t components,
                    std::uint64_t bytes, std::function<void(OutputFile&)> write) {
    std::string tag =
        "        <DataArray type=\"" + std::string(type) + "\" Name=\"" + std::string(name) + "\"";
    // VTK takes a missing count for 1, and some readers take "1" for a second axis.
    if (components > 1) tag += " NumberOfComponents=\"" + std::to_string(components) + "\"";
    tag += " format=\"appended\" offset=\"" + std::to_string(offset_) + "\"/>\n";
    offset_ += sizeof(std::uint64_t) + bytes;
    blocks_.push_back({bytes, std::move(write)});
    return tag;
  }
  template <class Numbers>
  std::string array(std::string_view name, Numbers numbers) {
    using Number = typename Numbers::value_type;
    return array(xml_type<Number>(), name, 1, numbers.size() * sizeof(Number),
                 [numbers](OutputFile& out) {
                   for (const Number number : numbers) out.write_binary(number);
                 });
  }
  void write(OutputFile& out) const {
    for (const auto& [bytes, write] : blocks_) {
      out.write_binary(bytes);
      write(out);
    }
  }

 private:
  struct Block {
    std::uint64_t bytes;
    std::function<void(OutputFile&)> write;
  };
  std::uint64_t offset_ = 0;
  std::vector<Block> blocks_;
};

constexpr std::string_view grid_head =
    "<?xml version=\"1.0\"?>\n"
    "<VTKFile type=\"UnstructuredGrid\" version=\"1.0\" byte_order=\"LittleEndian\" "
    "header_type=\"UInt64\">\n"
    "  <UnstructuredGrid>\n"
    "    <Piece NumberOfPoints=\"";

std::string part_name(const std::filesystem::path& file, std::size_t part) {
  return file.stem().string().append("_").append(std::to_string(part)).append(".vtu");
}

}  // namespace

void write_vtu(OutputFile& out, const Field& field) {
  const std::uint64_t vertices = field.vertices, cells = field.cell_count();
  Blocks blocks;
  std::string xml = std::string(grid_head) + std::to_string(vertices) + "\" NumberOfCells=\"" +
                    std::to_string(cells) + "\">\n";
  if (!field.distance.empty()) {
    xml += "      <PointData Scalars=\"distance\">\n";
    xml += blocks.array("distance", field.distance);
    field.each_more([&](const char* name, auto numbers) { xml += blocks.array(name, numbers); });
    xml += "      </PointData>\n";
  }
  xml += "      <Points>\n";
  xml += blocks.array("Float64", "Points", 3, 24 * vertices, [&](OutputFile& to) {
    for (const auto& position : field.positions)
      for (const double c : position) to.write_binary(c);
  });
  xml += "      </Points>\n      <Cells>\n";
  xml += blocks.array("Int64", "connectivity", 1, 8 * std::uint64_t{field.corner_count()},
                      [&](OutputFile& to) {
                        for (const Cells& kind : field.cells)
                          for (const std::uint32_t vertex : kind.connectivity)
                            to.write_binary(std::int64_t{vertex});
                      });
  xml += blocks.array("Int64", "offsets", 1, 8 * cells, [&](OutputFile& to) {
    std::int64_t end = 0;
    for (const Cells& kind : field.cells)
      for (std::size_t c = 0; c < kind.count(); ++c)
        to.write_binary(end += static_cast<std::int64_t>(kind.corners));
  });
  xml += blocks.array("UInt8", "types", 1, cells, [&](OutputFile& to) {
    for (const Cells& kind : field.cells)
      for (std::size_t c = 0; c < kind.count(); ++c) to.write_binary(kind.vtk_type());
  });
  xml +=
      "      </Cells>\n    </Piece>\n  </UnstructuredGrid>\n  <AppendedData encoding=\"raw\">\n_";
  out.write(xml);
  blocks.write(out);
  out.write("\n  </AppendedData>\n</VTKFile>\n");
}

bool is_partitioned(const std::filesystem::path& file) { return lower_extension(file) == ".pvtu"; }

std::filesystem::path part_of(const std::filesystem::path& file, std::size_t part) {
  return file.parent_path() / part_name(file, part);
}

FieldPart::FieldPart(const std::filesystem::path& file, const Field& whole, std::size_t part,
                     std::size_t parts)
    : out_(std::make_unique<OutputFile>(part_of(file, part))) {
  constexpr std::uint32_t nowhere = std::numeric_limits<std::uint32_t>::max();
  std::vector<std::uint32_t> number(whole.vertices, nowhere), original;
  std::vector<std::vector<std::uint32_t>> corners(whole.cells.size());
  std::vector<Cells> cells;
  const auto take = [&](std::uint32_t v) {
    if (number[v] == nowhere) {
      number[v] = static_cast<std::uint32_t>(original.size());
      original.push_back(v);
    }
    return number[v];
  };
  for (std::size_t k = 0; k < whole.cells.size(); ++k) {
    const Cells& all = whole.cells[k];
    const std::size_t begin = all.count() * part / parts, end = all.count() * (part + 1) / parts;
    for (std::size_t c = begin * all.corners; c < end * all.corners; ++c)
      corners[k].push_back(take(all.connectivity[c]));
    cells.push_back({all.corners, corners[k]});
  }
  if (part == 0) {
    std::vector<bool> in_cell(whole.vertices);
    for (const Cells& all : whole.cells)
      for (const std::uint32_t v : all.connectivity) in_cell[v] = true;
    for (std::uint32_t v = 0; v < whole.vertices; ++v)
      if (!in_cell[v]) take(v);
  }
  std::vector<std::array<double, 3>> positions;
  std::vector<double> distance, error;
  std::vector<std::int32_t> label;
  for (const std::uint32_t v : original) {
    positions.push_back(whole.positions[v]);
    distance.push_back(whole.distance[v]);
    if (!whole.label.empty()) label.push_back(whole.label[v]);
    if (!whole.error.empty()) error.push_back(whole.error[v]);
  }
  // Of points that were left out: as they were numbered before.
  if (!whole.original.empty())
    for (std::uint32_t& v : original) v = whole.original[v];
  write_vtu(*out_, {original.size(), positions, cells, distance, label, original, error});
  out_->flush();
}

FieldPart::FieldPart(const std::filesystem::path& file, const Field& own, std::size_t part)
    : out_(std::make_unique<OutputFile>(part_of(file, part))) {
  write_vtu(*out_, own);
  out_->flush();
}

void write_pvtu(const std::filesystem::path& file, const Field& whole,
                std::span<const std::size_t> parts) {
  OutputFile out(file);
  const auto array = [&](const std::string& type, const std::string& name,
                         const std::string& more = "") {
    out.write("      <PDataArray type=\"" + type + "\" Name=\"" + name + "\"" + more + "/>\n");
  };
  out.write(
      "<?xml version=\"1.0\"?>\n"
      "<VTKFile type=\"PUnstructuredGrid\" version=\"1.0\" byte_order=\"LittleEndian\" "
      "header_type=\"UInt64\">\n"
      "  <PUnstructuredGrid GhostLevel=\"0\">\n"
      "    <PPointData Scalars=\"distance\">\n");
  array("Float64", "distance");
  if (!whole.label.empty()) array("Int32", "label");
  array("UInt32", "original");
  if (!whole.error.empty()) array("Float64", "error");
  out.write("    </PPointData>\n    <PPoints>\n");
  array("Float64", "Points", " NumberOfComponents=\"3\"");
  out.write("    </PPoints>\n");
  for (const std::size_t part : parts)
    out.write("    <Piece Source=\"" + escape_xml(part_name(file, part)) + "\"/>\n");
  out.write("  </PUnstructuredGrid>\n</VTKFile>\n");
  out.commit();
}

}  // namespace plexway::io
