#include "shape/level_set_file.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include <plexway/error.hpp>
#include <plexway/io/field.hpp>
#include <plexway/io/paths.hpp>
#include <plexway/shape/isolines.hpp>

#include "io/extension.hpp"

namespace plexway {
namespace {

void write_isosurfaces(const std::filesystem::path& out, const AnyShape& solid,
                       std::span<const double> distance, std::span<const double> values) {
  Isosurfaces found = isosurfaces(solid, distance, values);
  std::vector<double> value;
  for (const Index n : found.value) value.push_back(values[n]);
  io::Triangles surface;
  surface.positions = std::move(found.positions);
  surface.triangles = std::move(found.triangles);
  const auto fields = io::field_extensions();
  if (std::find(fields.begin(), fields.end(), io::lower_extension(out)) != fields.end())
    io::write_field(out, surface, value);
  else
    io::write_triangles(out, surface);
}

}  // namespace

std::vector<std::string_view> level_set_extensions() {
  std::vector<std::string_view> all;
  for (const auto known : {io::path_extensions(), io::triangle_output_extensions()})
    for (const std::string_view name : known)
      if (std::find(all.begin(), all.end(), name) == all.end()) all.push_back(name);
  return all;
}

std::span<const std::string_view> level_set_extensions(DomainKind kind) {
  if (support(Purpose::isosurfaces, kind)) return io::triangle_output_extensions();
  support(Purpose::isolines, kind).require();
  return io::path_extensions();
}

std::vector<double> level_set_values(std::span<const double> distance, double step) {
  double most = 0;
  for (const double d : distance)
    if (std::isfinite(d)) most = std::max(most, d);
  if (most / step > 10000)
    throw UsageError(
        "the step of level sets: that would be more than 10000 values; take a larger step");
  std::vector<double> values;
  for (int n = 1; n * step < most; ++n) values.push_back(n * step);
  return values;
}

void write_level_sets(const std::filesystem::path& out, const AnyShape& shown,
                      const AnyDomain& domain, const AnyField& field, const AnyPathField* paths,
                      std::span<const double> values, double tolerance) {
  if (support(Purpose::isosurfaces, shown.kind()))
    return write_isosurfaces(out, shown, field.doubles(), values);
  const std::vector<Path> lines = paths != nullptr ? isolines(shown, *paths, values, tolerance)
                                                   : isolines(domain, field, values);
  io::write_isolines(out, lines, values);
}

}  // namespace plexway
