#include <plexway/io/field.hpp>

#include <numeric>
#include <string>
#include <vector>

#include <plexway/error.hpp>

#include "field_formats.hpp"
#include "io/extension.hpp"

namespace plexway::io {
namespace {

using FieldWriter = void (*)(OutputFile&, const Field&);

constexpr std::array<std::string_view, 7> field_suffixes = {".csv", ".npy", ".ply", ".vtk",
                                                            ".vtu", ".glb", ".gltf"};
constexpr std::array<FieldWriter, 7> field_writers = {write_csv, write_npy, write_ply, write_vtk,
                                                      write_vtu, write_glb, write_gltf};
constexpr std::size_t without_positions = 2;  ///< so many at the front need none

void require_length(std::string_view what, std::size_t length, std::size_t vertices) {
  if (length != vertices)
    throw UsageError("write_field: " + std::to_string(length) + " " + std::string(what) + " for " +
                     std::to_string(vertices) + " vertices");
}

}  // namespace

std::span<const std::string_view> field_extensions() { return field_suffixes; }

void write_field_of(const std::filesystem::path& file, const Field& field) {
  require_length("distances", field.distance.size(), field.vertices);
  if (!field.label.empty()) require_length("labels", field.label.size(), field.vertices);
  if (!field.original.empty())
    require_length("original numbers", field.original.size(), field.vertices);
  if (!field.error.empty()) require_length("errors", field.error.size(), field.vertices);
  const std::string extension = lower_extension(file);
  for (std::size_t i = 0; i < field_suffixes.size(); ++i) {
    if (extension != field_suffixes[i]) continue;
    if (i >= without_positions && field.positions.size() != field.vertices)
      throw UsageError(file.string() + ": " + extension +
                       " needs positions, and these vertices have none; .csv and .npy do without");
    OutputFile out(file);
    field_writers[i](out, field);
    out.commit();
    return;
  }
  throw UsageError(unknown_extension(file, field_suffixes));
}

void write_field(const std::filesystem::path& file, const Triangles& surface,
                 std::span<const double> distance, std::span<const std::int32_t> label,
                 std::span<const double> error) {
  const Cells cells = cells_of<3>(5, surface.triangles);
  write_field_of(
      file, {surface.positions.size(), surface.positions, {&cells, 1}, distance, label, {}, error});
}

void write_field(const std::filesystem::path& file, const Tets& solid,
                 std::span<const double> distance, std::span<const std::int32_t> label) {
  const Cells cells = cells_of<4>(10, solid.tets);
  write_field_of(file, {solid.positions.size(), solid.positions, {&cells, 1}, distance, label});
}

void write_field(const std::filesystem::path& file, const Edges& wireframe,
                 std::span<const double> distance, std::span<const std::int32_t> label) {
  const Cells cells = cells_of<2>(3, wireframe.edges);
  const bool placed = !wireframe.positions.empty();
  const std::size_t vertices = placed ? wireframe.positions.size() : wireframe.vertices;
  write_field_of(file, {vertices, wireframe.positions, {&cells, 1}, distance, label});
}

void write_field(const std::filesystem::path& file, const Points& cloud,
                 std::span<const double> distance, std::span<const std::int32_t> label,
                 std::span<const double> error) {
  std::vector<std::uint32_t> own(cloud.positions.size());
  std::iota(own.begin(), own.end(), 0u);
  const Cells cells = {1, 1, own};
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
  std::vector<std::array<std::uint32_t, 2>> edges;
  std::vector<std::array<std::uint32_t, 3>> triangles;
  std::vector<std::array<std::uint32_t, 4>> tets;
  for (const MixedPart& part : parts) {
    const auto add = [&](auto& all, const auto& own, const char* what) {
      for (std::size_t c = 0; c < own.size(); ++c) {
        all.push_back(own[c]);
        for (std::uint32_t& v : all.back()) {
          if (v >= part.positions.size())
            throw UsageError("write_field: " + std::string(what) + " " + std::to_string(c) +
                             " of a part names vertex " + std::to_string(v) + " of " +
                             std::to_string(part.positions.size()));
          v += static_cast<std::uint32_t>(positions.size());
        }
      }
    };
    add(edges, part.edges, "edge");
    add(triangles, part.triangles, "triangle");
    add(tets, part.tets, "tetrahedron");
    positions.insert(positions.end(), part.positions.begin(), part.positions.end());
  }
  std::vector<Cells> cells;
  if (!edges.empty()) cells.push_back(cells_of<2>(3, edges));
  if (!triangles.empty()) cells.push_back(cells_of<3>(5, triangles));
  if (!tets.empty()) cells.push_back(cells_of<4>(10, tets));
  write_field_of(file, {positions.size(), positions, cells, distance, label});
}

}  // namespace plexway::io
