// VTK's legacy format, binary, so big endian. Version 3.0, because older programs stop at what
// version 5 changed: its indices have 32 bits.

#include <limits>
#include <string>

#include <plexway/error.hpp>

#include "field_formats.hpp"

namespace plexway::io {

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
      out.write_big_endian(std::uint32_t{kind.vtk_type});
  if (!field.distance.empty()) {
    out.write("\nPOINT_DATA " + count(field.vertices) +
              "\nSCALARS distance double 1\nLOOKUP_TABLE default\n");
    for (const double d : field.distance) out.write_big_endian(d);
  }
  // Of several SCALARS many readers take the first alone.
  const int more = !field.label.empty() + !field.original.empty() + !field.error.empty();
  if (more > 0) out.write("\nFIELD FieldData " + std::to_string(more) + "\n");
  if (!field.label.empty()) {
    out.write("label 1 " + count(field.vertices) + " int\n");
    for (const std::int32_t l : field.label) out.write_big_endian(l);
  }
  if (!field.original.empty()) {
    out.write(std::string(field.label.empty() ? "" : "\n") + "original 1 " + count(field.vertices) +
              " unsigned_int\n");
    for (const std::uint32_t i : field.original) out.write_big_endian(i);
  }
  if (!field.error.empty()) {
    out.write(std::string(more == 1 ? "" : "\n") + "error 1 " + count(field.vertices) +
              " double\n");
    for (const double e : field.error) out.write_big_endian(e);
  }
  out.write("\n");
}

}  // namespace plexway::io
