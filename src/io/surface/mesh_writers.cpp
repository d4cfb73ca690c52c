// Surfaces and wireframes without a field.

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include <plexway/error.hpp>
#include <plexway/io/edges.hpp>
#include <plexway/io/triangles.hpp>

#include "io/bytes.hpp"
#include "io/extension.hpp"
#include "io/field/field_formats.hpp"

namespace plexway::io {
namespace {

using Position = std::array<double, 3>;

template <class Cells>
void require_sound(const char* what, std::span<const Position> positions, const Cells& cells) {
  for (std::size_t i = 0; i < positions.size(); ++i)
    for (const double c : positions[i])
      if (!std::isfinite(c))
        throw UsageError(std::string(what) + ": vertex " + std::to_string(i) +
                         " has a coordinate that is not finite");
  for (const auto& cell : cells)
    for (const std::uint32_t v : cell)
      if (v >= positions.size())
        throw UsageError(std::string(what) + ": a cell names vertex " + std::to_string(v) + " of " +
                         std::to_string(positions.size()));
}

template <class Numbers>
void write_row(OutputFile& out, const Numbers& numbers, std::uint32_t base = 0) {
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    if (i > 0) out.write(" ");
    if constexpr (std::is_same_v<typename Numbers::value_type, double>)
      out.write_text(numbers[i]);
    else
      out.write_text(std::uint64_t{numbers[i]} + base);
  }
}

template <class Cells>
void write_obj(OutputFile& out, std::span<const Position> positions, const Cells& cells,
               const char* letter) {
  for (const Position& p : positions) {
    out.write("v ");
    write_row(out, p);
    out.write("\n");
  }
  for (const auto& cell : cells) {
    out.write(letter);
    write_row(out, cell, 1);
    out.write("\n");
  }
}

void write_off(OutputFile& out, const Triangles& surface) {
  out.write("OFF\n" + std::to_string(surface.positions.size()) + " " +
            std::to_string(surface.triangles.size()) + " 0\n");
  for (const Position& p : surface.positions) {
    write_row(out, p);
    out.write("\n");
  }
  for (const auto& t : surface.triangles) {
    out.write("3 ");
    write_row(out, t);
    out.write("\n");
  }
}

void write_binary_ply(OutputFile& out, const Triangles& surface) {
  const bool fits = surface.positions.size() <= std::numeric_limits<std::int32_t>::max();
  out.write("ply\nformat binary_little_endian 1.0\ncomment by plexway\nelement vertex " +
            std::to_string(surface.positions.size()) +
            "\nproperty double x\nproperty double y\nproperty double z\nelement face " +
            std::to_string(surface.triangles.size()) + "\nproperty list uchar " +
            (fits ? "int" : "uint") + " vertex_indices\nend_header\n");
  for (const Position& p : surface.positions)
    for (const double c : p) out.write_binary(c);
  for (const auto& t : surface.triangles) {
    out.write_binary(std::uint8_t{3});
    for (const std::uint32_t v : t) out.write_binary(v);
  }
}

// Binary: 80 bytes of nothing, a count, and 50 bytes a triangle in single precision.
void write_stl(OutputFile& out, const Triangles& surface) {
  if (surface.triangles.size() > std::numeric_limits<std::uint32_t>::max())
    throw Error("an .stl counts triangles with 32 bits, which is too few here");
  std::string head = "surface by plexway";
  head.resize(80, ' ');
  out.write(head);
  out.write_binary(static_cast<std::uint32_t>(surface.triangles.size()));
  for (const auto& t : surface.triangles) {
    std::array<Position, 3> p;
    for (std::size_t i = 0; i < 3; ++i) p[i] = surface.positions[t[i]];
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

constexpr std::array<std::string_view, 8> surface_extensions = {".obj", ".off", ".ply", ".stl",
                                                                ".vtu", ".vtk", ".glb", ".gltf"};
constexpr std::array<std::string_view, 6> wire_extensions = {".obj", ".edges", ".vtu",
                                                             ".vtk", ".glb",   ".gltf"};

void write_cells(OutputFile& out, const std::string& extension, const Field& mesh) {
  if (extension == ".vtu") return write_vtu(out, mesh);
  if (extension == ".vtk") return write_vtk(out, mesh);
  if (extension == ".glb") return write_glb(out, mesh);
  write_gltf(out, mesh);
}

void require_known(const std::filesystem::path& file, std::span<const std::string_view> known) {
  const std::string extension = lower_extension(file);
  if (std::find(known.begin(), known.end(), extension) == known.end())
    throw UsageError(unknown_extension(file, known));
}

}  // namespace

std::span<const std::string_view> triangle_output_extensions() { return surface_extensions; }

std::span<const std::string_view> edge_output_extensions() { return wire_extensions; }

void write_triangles(const std::filesystem::path& file, const Triangles& surface) {
  require_known(file, surface_extensions);
  require_sound("write_triangles", surface.positions, surface.triangles);
  const std::string extension = lower_extension(file);
  OutputFile out(file);
  if (extension == ".stl")
    for (const Position& p : surface.positions)
      if (!fits_float(p[0]) || !fits_float(p[1]) || !fits_float(p[2]))
        throw UsageError("a coordinate is too large for .stl, which has single precision only");
  if (extension == ".obj") {
    write_obj(out, surface.positions, surface.triangles, "f ");
  } else if (extension == ".off") {
    write_off(out, surface);
  } else if (extension == ".ply") {
    write_binary_ply(out, surface);
  } else if (extension == ".stl") {
    write_stl(out, surface);
  } else {
    const Cells cells = cells_of<3>(5, surface.triangles);
    write_cells(out, extension, {surface.positions.size(), surface.positions, {&cells, 1}, {}, {}});
  }
  out.commit();
}

void write_edges(const std::filesystem::path& file, const Edges& wireframe) {
  require_known(file, wire_extensions);
  const std::string extension = lower_extension(file);
  const bool placed = !wireframe.positions.empty();
  if (!placed && extension != ".edges")
    throw UsageError(file.string() + ": " + extension +
                     " needs positions, and these vertices have none; .edges does without");
  if (placed) require_sound("write_edges", wireframe.positions, wireframe.edges);
  OutputFile out(file);
  if (extension == ".obj") {
    write_obj(out, wireframe.positions, wireframe.edges, "l ");
  } else if (extension == ".edges") {
    out.write("vertices " +
              std::to_string(placed ? wireframe.positions.size() : wireframe.vertices) + "\n");
    for (std::size_t e = 0; e < wireframe.edges.size(); ++e) {
      const auto& [a, b] = wireframe.edges[e];
      write_row(out, wireframe.edges[e]);
      if (!wireframe.lengths.empty() || placed) {
        double length = wireframe.lengths.empty() ? 0 : wireframe.lengths[e];
        if (wireframe.lengths.empty()) {
          const Position &p = wireframe.positions[a], &q = wireframe.positions[b];
          length = std::hypot(p[0] - q[0], p[1] - q[1], p[2] - q[2]);
        }
        out.write(" ");
        out.write_text(length);
      }
      out.write("\n");
    }
  } else {
    const Cells cells = cells_of<2>(3, wireframe.edges);
    write_cells(out, extension,
                {wireframe.positions.size(), wireframe.positions, {&cells, 1}, {}, {}});
  }
  out.commit();
}

}  // namespace plexway::io
