#include "io/field/field_part.hpp"

#include <array>
#include <cstdint>
#include <limits>
#include <string>
#include <string_view>
#include <vector>

#include "io/extension.hpp"

namespace plexway::io {
namespace {

std::string part_name(const std::filesystem::path& file, std::size_t part) {
  return file.stem().string().append("_").append(std::to_string(part)).append(".vtu");
}

std::string escaped(const std::string& text) {
  std::string out;
  for (const char c : text) {
    if (c == '&')
      out += "&amp;";
    else if (c == '<')
      out += "&lt;";
    else if (c == '"')
      out += "&quot;";
    else
      out += c;
  }
  return out;
}

}  // namespace

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
    cells.push_back({all.vtk_type, all.corners, corners[k]});
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
  const auto array = [&](std::string_view type, std::string_view name, std::string_view more = "") {
    out.write("      <PDataArray type=\"");
    out.write(type);
    out.write("\" Name=\"");
    out.write(name);
    out.write("\"");
    out.write(more);
    out.write("/>\n");
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
    out.write("    <Piece Source=\"" + escaped(part_name(file, part)) + "\"/>\n");
  out.write("  </PUnstructuredGrid>\n</VTKFile>\n");
  out.commit();
}

}  // namespace plexway::io
