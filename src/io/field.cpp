#include <plexway/io/field.hpp>

#include <string>

#include <plexway/error.hpp>

#include "extension.hpp"
#include "field_formats.hpp"

namespace plexway::io {
namespace {

using Writer = void (*)(OutputFile&, const Field&);

constexpr std::array<std::string_view, 5> extensions = {".csv", ".npy", ".ply", ".vtk", ".vtu"};
constexpr std::array<Writer, 5> writers = {write_csv, write_npy, write_ply, write_vtk, write_vtu};
constexpr std::size_t without_positions = 2;  ///< so many at the front need none

void require_length(std::string_view what, std::size_t length, std::size_t vertices) {
  if (length != vertices)
    throw UsageError("write_field: " + std::to_string(length) + " " + std::string(what) + " for " +
                     std::to_string(vertices) + " vertices");
}

}  // namespace

std::span<const std::string_view> field_extensions() { return extensions; }

void write_field_of(const std::filesystem::path& file, const Field& field) {
  require_length("distances", field.distance.size(), field.vertices);
  if (!field.label.empty()) require_length("labels", field.label.size(), field.vertices);
  const std::string extension = lower_extension(file);
  for (std::size_t i = 0; i < extensions.size(); ++i) {
    if (extension != extensions[i]) continue;
    if (i >= without_positions && field.positions.size() != field.vertices)
      throw UsageError(file.string() + ": " + extension +
                       " needs positions, and these vertices have none; .csv and .npy do without");
    OutputFile out(file);
    writers[i](out, field);
    out.commit();
    return;
  }
  throw UsageError(unknown_extension(file, extensions));
}

void write_field(const std::filesystem::path& file, const Triangles& surface,
                 std::span<const double> distance, std::span<const std::int32_t> label) {
  const Cells cells = cells_of<3>(5, surface.triangles);
  write_field_of(file, {surface.positions.size(), surface.positions, {&cells, 1}, distance, label});
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

}  // namespace plexway::io
