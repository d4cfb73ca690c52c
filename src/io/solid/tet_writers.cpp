#include <cmath>
#include <string>

#include <plexway/error.hpp>
#include <plexway/io/tets.hpp>

#include "io/extension.hpp"
#include "io/field/field_formats.hpp"

namespace plexway::io {
namespace {

namespace fs = std::filesystem;

void require_sound_tets(const Tets& solid) {
  const auto fail = [](const char* what, std::size_t i, const std::string& cause) {
    throw UsageError("write_tets: " + std::string(what) + " " + std::to_string(i) + cause);
  };
  for (std::size_t i = 0; i < solid.positions.size(); ++i)
    for (const double c : solid.positions[i])
      if (!std::isfinite(c)) fail("vertex", i, " has a coordinate that is not finite");
  for (std::size_t i = 0; i < solid.tets.size(); ++i)
    for (const std::uint32_t vertex : solid.tets[i])
      if (vertex >= solid.positions.size())
        fail("tetrahedron", i,
             " names vertex " + std::to_string(vertex) + " of " +
                 std::to_string(solid.positions.size()));
}

/// Numbers with blanks between them.
template <class Numbers>
void write_tet_row(OutputFile& out, const Numbers& numbers, std::uint32_t base = 0) {
  std::string_view separator = "";
  for (const auto number : numbers) {
    out.write(separator);
    if constexpr (std::is_same_v<decltype(number), const double>)
      out.write_text(number);
    else
      out.write_text(std::uint64_t{number} + base);
    separator = " ";
  }
}

/// Numbered from 0. Both files are written before either takes its place.
void write_pair(const fs::path& file, const Tets& solid) {
  fs::path node_name = file;
  fs::path ele_name = file;
  const bool capital = file.extension() == ".NODE" || file.extension() == ".ELE";
  if (lower_extension(file) != ".node") node_name.replace_extension(capital ? ".NODE" : ".node");
  if (lower_extension(file) != ".ele") ele_name.replace_extension(capital ? ".ELE" : ".ele");
  OutputFile node(node_name);
  OutputFile ele(ele_name);
  node.write(std::to_string(solid.positions.size()) + " 3 0 0\n");
  for (std::size_t i = 0; i < solid.positions.size(); ++i) {
    node.write_text(i);
    node.write(" ");
    write_tet_row(node, solid.positions[i]);
    node.write("\n");
  }
  ele.write(std::to_string(solid.tets.size()) + " 4 0\n");
  for (std::size_t i = 0; i < solid.tets.size(); ++i) {
    ele.write_text(i);
    ele.write(" ");
    write_tet_row(ele, solid.tets[i]);
    ele.write("\n");
  }
  node.commit();
  ele.commit();
}

void write_medit(OutputFile& out, const Tets& solid) {
  // Version 2: coordinates are doubles.
  out.write("MeshVersionFormatted 2\nDimension 3\n\nVertices\n" +
            std::to_string(solid.positions.size()) + "\n");
  for (const auto& position : solid.positions) {
    write_tet_row(out, position);
    out.write(" 0\n");
  }
  out.write("\nTetrahedra\n" + std::to_string(solid.tets.size()) + "\n");
  for (const auto& tet : solid.tets) {
    write_tet_row(out, tet, 1);
    out.write(" 0\n");
  }
  out.write("\nEnd\n");
}

/// Version 2.2, ascii: the one that every program reads. Each element gets the tags 1 1, its
/// physical and its elementary entity.
void write_gmsh(OutputFile& out, const Tets& solid) {
  out.write("$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n" +
            std::to_string(solid.positions.size()) + "\n");
  for (std::size_t i = 0; i < solid.positions.size(); ++i) {
    out.write_text(i + 1);
    out.write(" ");
    write_tet_row(out, solid.positions[i]);
    out.write("\n");
  }
  out.write("$EndNodes\n$Elements\n" + std::to_string(solid.tets.size()) + "\n");
  for (std::size_t i = 0; i < solid.tets.size(); ++i) {
    out.write_text(i + 1);
    out.write(" 4 2 1 1 ");
    write_tet_row(out, solid.tets[i], 1);
    out.write("\n");
  }
  out.write("$EndElements\n");
}

}  // namespace

void write_tets(const fs::path& file, const Tets& solid) {
  require_sound_tets(solid);
  const std::string extension = lower_extension(file);
  if (extension == ".node" || extension == ".ele") return write_pair(file, solid);
  const Cells cells = cells_of<4>(10, solid.tets);
  const Field field{solid.positions.size(), solid.positions, {&cells, 1}, {}, {}};
  const auto write = [&](auto writer, const auto& what) {
    OutputFile out(file);
    writer(out, what);
    out.commit();
  };
  if (extension == ".mesh") return write(write_medit, solid);
  if (extension == ".msh") return write(write_gmsh, solid);
  if (extension == ".vtu") return write(write_vtu, field);
  if (extension == ".vtk") return write(write_vtk, field);
  throw UsageError(unknown_extension(file, tet_extensions()));
}

}  // namespace plexway::io
