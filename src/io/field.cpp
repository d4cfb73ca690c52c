#include <plexway/io/field.hpp>

#include <string>

#include <plexway/error.hpp>

#include "extension.hpp"
#include "field_formats.hpp"

namespace plexway::io {
namespace {

using Writer = void (*)(OutputFile&, const Field&);

constexpr std::array<std::string_view, 4> extensions = {".csv", ".npy", ".ply", ".vtu"};
constexpr std::array<Writer, 4> writers = {write_csv, write_npy, write_ply, write_vtu};

void require_length(std::string_view what, std::size_t length, std::size_t vertices) {
  if (length != vertices)
    throw UsageError("write_field: " + std::to_string(length) + " " + std::string(what) + " for " +
                     std::to_string(vertices) + " vertices");
}

}  // namespace

std::span<const std::string_view> field_extensions() { return extensions; }

void write_field(const std::filesystem::path& file, const Triangles& surface,
                 std::span<const double> distance, std::span<const std::int32_t> label) {
  require_length("distances", distance.size(), surface.positions.size());
  if (!label.empty()) require_length("labels", label.size(), surface.positions.size());
  const std::string extension = lower_extension(file);
  for (std::size_t i = 0; i < extensions.size(); ++i) {
    if (extension != extensions[i]) continue;
    OutputFile out(file);
    writers[i](out, {surface, distance, label});
    out.commit();
    return;
  }
  throw UsageError(unknown_extension(file, extensions));
}

}  // namespace plexway::io
