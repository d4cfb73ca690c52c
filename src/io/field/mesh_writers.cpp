// Surfaces, solids and wireframes without a field.

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <string>
#include <utility>

#include <plexway/error.hpp>
#include <plexway/io/edges.hpp>
#include <plexway/io/tets.hpp>
#include <plexway/io/triangles.hpp>

#include "io/field/field_formats.hpp"
#include "io/names.hpp"
#include "io/numbers.hpp"

namespace plexway::io {
namespace {

using Position = std::array<double, 3>;

/// The mesh of a file, whatever it is of: its vertices, and cells of one kind.
Field mesh_of(std::span<const Position> positions, const Cells& cells) {
  return {positions.size(), positions, {&cells, 1}, {}, {}};
}

void require_sound(const std::string& what, const Field& mesh) {
  constexpr std::array<const char*, 5> names = {"", "vertex", "edge", "triangle", "tetrahedron"};
  for (std::size_t i = 0; i < mesh.vertices; ++i)
    for (const double c : mesh.positions[i])
      if (!std::isfinite(c))
        throw UsageError(what + ": vertex " + std::to_string(i) +
                         " has a coordinate that is not finite");
  const Cells& cells = mesh.cells.front();
  for (std::size_t i = 0; i < cells.connectivity.size(); ++i)
    if (cells.connectivity[i] >= mesh.vertices)
      throw UsageError(what + ": " + names[cells.corners] + " " +
                       std::to_string(i / cells.corners) + " names vertex " +
                       std::to_string(cells.connectivity[i]) + " of " +
                       std::to_string(mesh.vertices));
}

// A row of text for each vertex: its number from `first` on, where there is one, its place between
// what stands before and behind.
void write_vertices(OutputFile& out, const Field& mesh, std::string_view before,
                    std::string_view behind, std::optional<std::size_t> first = {}) {
  for (std::size_t i = 0; i < mesh.vertices; ++i) {
    if (first) out.write(i + *first);
    out.write(before);
    out.write_row(mesh.positions[i], " ");
    out.write(behind);
  }
}

// The same for each cell; its vertices are counted from `base`.
void write_cells(OutputFile& out, const Field& mesh, std::uint32_t base, std::string_view before,
                 std::string_view behind, std::optional<std::size_t> first = {}) {
  const Cells& cells = mesh.cells.front();
  for (std::size_t i = 0; i < cells.count(); ++i) {
    if (first) out.write(i + *first);
    out.write(before);
    for (std::size_t k = 0; k < cells.corners; ++k)
      out.write(k > 0 ? " " : "", std::uint64_t{cells.connectivity[i * cells.corners + k]} + base);
    out.write(behind);
  }
}

std::string vertices_in(const Field& mesh) { return std::to_string(mesh.vertices); }
std::string cells_in(const Field& mesh) { return std::to_string(mesh.cell_count()); }

void write_obj(OutputFile& out, const Field& mesh) {
  write_vertices(out, mesh, "v ", "\n");
  write_cells(out, mesh, 1, mesh.cells.front().corners == 2 ? "l " : "f ", "\n");
}

void write_off(OutputFile& out, const Field& mesh) {
  out.write("OFF\n" + vertices_in(mesh) + " " + cells_in(mesh) + " 0\n");
  write_vertices(out, mesh, "", "\n");
  write_cells(out, mesh, 0, "3 ", "\n");
}

// Binary: 80 bytes of nothing, a count, and 50 bytes a triangle in single precision.
void write_stl(OutputFile& out, const Field& mesh) {
  const std::size_t triangles = mesh.cell_count();
  if (triangles > std::numeric_limits<std::uint32_t>::max())
    throw Error("an .stl counts triangles with 32 bits, which is too few here");
  for (const Position& p : mesh.positions)
    if (!fits_float(p[0]) || !fits_float(p[1]) || !fits_float(p[2]))
      throw UsageError("a coordinate is too large for .stl, which has single precision only");
  std::string head = "surface by plexway";
  head.resize(80, ' ');
  out.write(head);
  out.write_binary(static_cast<std::uint32_t>(triangles));
  for (std::size_t t = 0; t < triangles; ++t) {
    std::array<Position, 3> p;
    for (std::size_t i = 0; i < 3; ++i)
      p[i] = mesh.positions[mesh.cells.front().connectivity[3 * t + i]];
    Position u, v;
    for (std::size_t k = 0; k < 3; ++k) {
      u[k] = p[1][k] - p[0][k];
      v[k] = p[2][k] - p[0][k];
    }
    const Position normal = {u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2],
                             u[0] * v[1] - u[1] * v[0]};
    const double length = std::hypot(normal[0], normal[1], normal[2]);
    for (const double c : normal) out.write_binary(static_cast<float>(length > 0 ? c / length : 0));
    for (const Position& corner : p)
      for (const double c : corner) out.write_binary(static_cast<float>(c));
    out.write_binary(std::uint16_t{0});
  }
}

// Version 2: coordinates are doubles.
void write_medit(OutputFile& out, const Field& mesh) {
  out.write("MeshVersionFormatted 2\nDimension 3\n\nVertices\n" + vertices_in(mesh) + "\n");
  write_vertices(out, mesh, "", " 0\n");
  out.write("\nTetrahedra\n" + cells_in(mesh) + "\n");
  write_cells(out, mesh, 1, "", " 0\n");
  out.write("\nEnd\n");
}

// Version 2.2, ascii: the one that every program reads. Each element gets the tags 1 1, its
// physical and its elementary entity.
void write_gmsh(OutputFile& out, const Field& mesh) {
  out.write("$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n" + vertices_in(mesh) + "\n");
  write_vertices(out, mesh, " ", "\n", 1);
  out.write("$EndNodes\n$Elements\n" + cells_in(mesh) + "\n");
  write_cells(out, mesh, 1, " 4 2 1 1 ", "\n", 1);
  out.write("$EndElements\n");
}

// Numbered from 0. Both files are written before either takes its place.
void write_node_ele(const std::filesystem::path& file, const Field& mesh) {
  std::filesystem::path node_name = file, ele_name = file;
  const bool capital = file.extension() == ".NODE" || file.extension() == ".ELE";
  if (lower_extension(file) != ".node") node_name.replace_extension(capital ? ".NODE" : ".node");
  if (lower_extension(file) != ".ele") ele_name.replace_extension(capital ? ".ELE" : ".ele");
  OutputFile node(node_name), ele(ele_name);
  node.write(vertices_in(mesh) + " 3 0 0\n");
  write_vertices(node, mesh, " ", "\n", 0);
  ele.write(cells_in(mesh) + " 4 0\n");
  write_cells(ele, mesh, 0, " ", "\n", 0);
  node.commit();
  ele.commit();
}

constexpr std::array<std::string_view, 8> surface_extensions = {".obj", ".off", ".ply", ".stl",
                                                                ".vtu", ".vtk", ".glb", ".gltf"};
constexpr std::array<std::string_view, 6> wire_extensions = {".obj", ".edges", ".vtu",
                                                             ".vtk", ".glb",   ".gltf"};
constexpr std::array<std::string_view, 6> solid_extensions = {".node", ".ele", ".mesh",
                                                              ".msh",  ".vtu", ".vtk"};

void write_mesh(const std::filesystem::path& file, const Field& mesh) {
  constexpr std::pair<std::string_view, void (*)(OutputFile&, const Field&)> writers[] = {
      {".obj", write_obj},    {".off", write_off},  {".ply", write_ply}, {".stl", write_stl},
      {".mesh", write_medit}, {".msh", write_gmsh}, {".vtu", write_vtu}, {".vtk", write_vtk},
      {".glb", write_glb},    {".gltf", write_gltf}};
  const std::string extension = lower_extension(file);
  OutputFile out(file);
  for (const auto& [known, write] : writers)
    if (extension == known) write(out, mesh);
  out.commit();
}

// Throws UsageError for an extension that is none of them.
std::string known_extension(const std::filesystem::path& file,
                            std::span<const std::string_view> known) {
  std::string extension = lower_extension(file);
  if (std::find(known.begin(), known.end(), extension) == known.end())
    throw UsageError(unknown_extension(file, known));
  return extension;
}

}  // namespace

std::span<const std::string_view> triangle_output_extensions() { return surface_extensions; }
std::span<const std::string_view> edge_output_extensions() { return wire_extensions; }
std::span<const std::string_view> tet_extensions() { return solid_extensions; }

void write_triangles(const std::filesystem::path& file, const Triangles& surface) {
  static_cast<void>(known_extension(file, surface_extensions));
  const Cells cells = cells_of(surface.triangles);
  const Field mesh = mesh_of(surface.positions, cells);
  require_sound("write_triangles", mesh);
  write_mesh(file, mesh);
}

void write_tets(const std::filesystem::path& file, const Tets& solid) {
  const std::string extension = known_extension(file, solid_extensions);
  const Cells cells = cells_of(solid.tets);
  const Field mesh = mesh_of(solid.positions, cells);
  require_sound("write_tets", mesh);
  if (extension == ".node" || extension == ".ele") return write_node_ele(file, mesh);
  write_mesh(file, mesh);
}

void write_edges(const std::filesystem::path& file, const Edges& wireframe) {
  const std::string extension = known_extension(file, wire_extensions);
  const bool placed = !wireframe.positions.empty();
  if (!placed && extension != ".edges")
    throw UsageError(file.string() + ": " + extension +
                     " needs positions, and these vertices have none; .edges does without");
  const Cells cells = cells_of(wireframe.edges);
  const Field mesh = mesh_of(wireframe.positions, cells);
  if (placed) require_sound("write_edges", mesh);
  if (extension != ".edges") return write_mesh(file, mesh);
  OutputFile out(file);
  out.write("vertices " + std::to_string(placed ? mesh.vertices : wireframe.vertices) + "\n");
  for (std::size_t e = 0; e < wireframe.edges.size(); ++e) {
    const auto& [a, b] = wireframe.edges[e];
    out.write(std::to_string(a) + " " + std::to_string(b));
    if (!wireframe.lengths.empty() || placed) {
      double length = wireframe.lengths.empty() ? 0 : wireframe.lengths[e];
      if (wireframe.lengths.empty()) {
        const Position &p = wireframe.positions[a], &q = wireframe.positions[b];
        length = std::hypot(p[0] - q[0], p[1] - q[1], p[2] - q[2]);
      }
      out.write(" ", length);
    }
    out.write("\n");
  }
  out.commit();
}

}  // namespace plexway::io
