#include <plexway/io/field.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <string>
#include <type_traits>
#include <vector>

#include <plexway/error.hpp>

#include "io/field/colours.hpp"
#include "io/field/field_formats.hpp"
#include "io/matrix/npy.hpp"
#include "io/names.hpp"

namespace plexway::io {

void write_csv(OutputFile& out, const Field& field) {
  out.write(field.positions.empty() ? "vertex,distance" : "vertex,x,y,z,distance");
  field.each_more([&](const char* name, auto) { out.write(",", name); });
  out.write("\n");
  for (std::size_t i = 0; i < field.distance.size(); ++i) {
    out.write(i, ",");
    if (!field.positions.empty()) out.write_row(field.positions[i], ","), out.write(",");
    out.write(field.distance[i]);
    field.each_more([&](const char*, auto numbers) { out.write(",", numbers[i]); });
    out.write("\n");
  }
}

void write_npy(OutputFile& out, const Field& field) {
  const bool records = !field.original.empty();
  out.write(npy_header(records ? "[('distance', '<f8'), ('original', '<u4')]" : "'<f8'",
                       std::to_string(field.distance.size()) + ","));
  for (std::size_t i = 0; i < field.distance.size(); ++i) {
    out.write_binary(field.distance[i]);
    if (records) out.write_binary(field.original[i]);
  }
}

// Binary: `quality` is the name under which mesh viewers look for a scalar, the colours are for
// those that show nothing else.
void write_ply(OutputFile& out, const Field& field) {
  const bool values = !field.distance.empty();
  // Most readers expect `int` indices; beyond its range there is only `uint`.
  const bool fits = field.vertices <= std::numeric_limits<std::int32_t>::max();
  const std::string index = fits ? "int" : "uint";
  std::string header = "ply\nformat binary_little_endian 1.0\ncomment " +
                       std::string(values ? "geodesic distance " : "") +
                       "by plexway\nelement vertex " + std::to_string(field.vertices) +
                       "\nproperty double x\nproperty double y\nproperty double z\n";
  if (values)
    header +=
        "property double quality\n"
        "property uchar red\nproperty uchar green\nproperty uchar blue\n";
  field.each_more([&]<class Numbers>(const std::string& name, Numbers) {
    constexpr bool is_real = std::is_same_v<typename Numbers::value_type, double>;
    header += "property " +
              (is_real           ? "double"
               : name == "label" ? "int"
                                 : index) +
              " " + name + "\n";
  });
  const auto list = [&](std::size_t corners, const auto& use) {
    for (const Cells& kind : field.cells)
      if (kind.corners == corners) use(kind);
  };
  std::size_t faces = 0, edges = 0;
  list(3, [&](const Cells& kind) { faces += kind.count(); });
  list(2, [&](const Cells& kind) { edges += kind.count(); });
  if (faces != 0 || !values)
    header += "element face " + std::to_string(faces) + "\nproperty list uchar " + index +
              " vertex_indices\n";
  if (edges != 0)
    header += "element edge " + std::to_string(edges) + "\nproperty " + index +
              " vertex1\nproperty " + index + " vertex2\n";
  out.write(header + "end_header\n");

  double largest = 0;
  for (const double d : field.distance)
    if (std::isfinite(d) && d > largest) largest = d;
  const ColourMap colour;
  for (std::size_t i = 0; i < field.vertices; ++i) {
    for (const double c : field.positions[i]) out.write_binary(c);
    if (!values) continue;
    out.write_binary(field.distance[i]);
    for (const std::uint8_t c : colour(field.distance[i], largest)) out.write_binary(c);
    field.each_more([&](const char*, auto numbers) { out.write_binary(numbers[i]); });
  }
  for (const std::size_t corners : {std::size_t{3}, std::size_t{2}})
    list(corners, [&](const Cells& kind) {
      for (std::size_t i = 0; i < kind.connectivity.size(); ++i) {
        if (corners == 3 && i % 3 == 0) out.write_binary(std::uint8_t{3});
        out.write_binary(kind.connectivity[i]);
      }
    });
}

namespace {

using FieldWriter = void (*)(OutputFile&, const Field&);

constexpr std::array<std::string_view, 8> field_suffixes = {".csv", ".npy", ".gii", ".ply",
                                                            ".vtk", ".vtu", ".glb", ".gltf"};
constexpr std::array<FieldWriter, 8> field_writers = {
    write_csv, write_npy, write_gifti, write_ply, write_vtk, write_vtu, write_glb, write_gltf};
constexpr std::size_t without_positions = 3;  ///< so many at the front need none

void require_length(std::string_view what, std::size_t length, std::size_t vertices) {
  if (length != vertices)
    throw UsageError("write_field: " + std::to_string(length) + " " + std::string(what) + " for " +
                     std::to_string(vertices) + " vertices");
}

}  // namespace

std::span<const std::string_view> field_extensions() { return field_suffixes; }

void write_field_of(const std::filesystem::path& file, const Field& field) {
  require_length("distances", field.distance.size(), field.vertices);
  field.each_more([&](const std::string& name, auto numbers) {
    require_length(name == "original" ? "original numbers" : name + "s", numbers.size(),
                   field.vertices);
  });
  const std::string extension = lower_extension(file);
  const auto known = std::find(field_suffixes.begin(), field_suffixes.end(), extension);
  if (known == field_suffixes.end()) throw UsageError(unknown_extension(file, field_suffixes));
  const auto format = static_cast<std::size_t>(known - field_suffixes.begin());
  if (format >= without_positions && field.positions.size() != field.vertices)
    throw UsageError(
        file.string() + ": " + extension +
        " needs positions, and these vertices have none; .csv, .npy and .gii do without");
  OutputFile out(file);
  field_writers[format](out, field);
  out.commit();
}

void write_field(const std::filesystem::path& file, const Triangles& surface,
                 std::span<const double> distance, std::span<const std::int32_t> label,
                 std::span<const double> error) {
  const Cells cells = cells_of(surface.triangles);
  write_field_of(
      file, {surface.positions.size(), surface.positions, {&cells, 1}, distance, label, {}, error});
}

void write_field(const std::filesystem::path& file, const Tets& solid,
                 std::span<const double> distance, std::span<const std::int32_t> label) {
  const Cells cells = cells_of(solid.tets);
  write_field_of(file, {solid.positions.size(), solid.positions, {&cells, 1}, distance, label});
}

void write_field(const std::filesystem::path& file, const Edges& wireframe,
                 std::span<const double> distance, std::span<const std::int32_t> label) {
  const Cells cells = cells_of(wireframe.edges);
  const bool placed = !wireframe.positions.empty();
  const std::size_t vertices = placed ? wireframe.positions.size() : wireframe.vertices;
  write_field_of(file, {vertices, wireframe.positions, {&cells, 1}, distance, label});
}

void write_field(const std::filesystem::path& file, const Points& cloud,
                 std::span<const double> distance, std::span<const std::int32_t> label,
                 std::span<const double> error) {
  std::vector<std::uint32_t> own(cloud.positions.size());
  std::iota(own.begin(), own.end(), 0u);
  const Cells cells = {1, own};
  write_field_of(file, {cloud.positions.size(),
                        cloud.positions,
                        {&cells, 1},
                        distance,
                        label,
                        cloud.original,
                        error});
}

void write_field(const std::filesystem::path& file, std::span<const MixedPart> parts,
                 std::span<const double> distance, std::span<const std::int32_t> label) {
  std::vector<std::array<double, 3>> positions;
  std::array<std::vector<std::uint32_t>, 3> corners;  // of edges, triangles and tetrahedra
  constexpr std::array<const char*, 3> names = {"edge", "triangle", "tetrahedron"};
  for (const MixedPart& part : parts) {
    for (const Cells& own : {cells_of(part.edges), cells_of(part.triangles), cells_of(part.tets)})
      for (std::size_t i = 0; i < own.connectivity.size(); ++i) {
        const std::uint32_t v = own.connectivity[i];
        if (v >= part.positions.size())
          throw UsageError("write_field: " + std::string(names[own.corners - 2]) + " " +
                           std::to_string(i / own.corners) + " of a part names vertex " +
                           std::to_string(v) + " of " + std::to_string(part.positions.size()));
        corners[own.corners - 2].push_back(v + static_cast<std::uint32_t>(positions.size()));
      }
    positions.insert(positions.end(), part.positions.begin(), part.positions.end());
  }
  std::vector<Cells> cells;
  for (std::size_t k = 0; k < corners.size(); ++k)
    if (!corners[k].empty()) cells.push_back({k + 2, corners[k]});
  write_field_of(file, {positions.size(), positions, cells, distance, label});
}

}  // namespace plexway::io
