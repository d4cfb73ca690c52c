#include "cli/options/isoline_options.hpp"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <variant>
#include <vector>

#include <plexway/any/isolines.hpp>
#include <plexway/apps/isosurfaces.hpp>
#include <plexway/error.hpp>
#include <plexway/io/field.hpp>
#include <plexway/io/paths.hpp>

#include "any/arguments/require.hpp"
#include "cli/report/distance_output.hpp"
#include "io/extension.hpp"

namespace plexway::cli {
namespace {

// Of lines, and of the triangles that a solid has instead.
std::vector<std::string_view> extensions() {
  std::vector<std::string_view> all;
  for (const auto known : {io::path_extensions(), io::triangle_output_extensions()})
    for (const std::string_view name : known)
      if (std::find(all.begin(), all.end(), name) == all.end()) all.push_back(name);
  return all;
}

// With the value at each vertex where the format has room for it.
void write_isosurfaces(const std::string& out, const io::Tets& solid,
                       std::span<const double> distance, std::span<const double> values) {
  Isosurfaces found = isosurfaces(solid.positions, solid.tets, distance, values);
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

void add_isoline_options(CLI::App& command, IsolineOptions& options) {
  command
      .add_option(
          "--isoline-step", options.step,
          "lines on a surface or a cloud, or surfaces in a solid, at each multiple of this\n"
          "distance, for --isolines-out")
      ->type_name("STEP");
  add_output(command, "--isolines-out", options.out,
             "where to: .obj (lines), .ply, .vtp or .json; of a solid .obj, .off, .ply, .stl,\n"
             ".glb, .gltf or .vtu (triangles); - for .obj on standard output",
             "obj");
}

void check_isolines(const IsolineOptions& options, const std::string& input) {
  if (options.out.empty() != !options.step)
    throw UsageError("--isoline-step STEP and --isolines-out FILE go together");
  if (options.step && !(*options.step > 0 && std::isfinite(*options.step)))
    throw UsageError("--isoline-step: the step must be > 0");
  check_output_name(options.out, input, extensions(), "--isolines-out");
}

void check_isolines(const IsolineOptions& options, const Domain& domain) {
  if (options.out.empty()) return;
  const bool solid = domain.kind() == DomainKind::solid;
  if (!solid)
    require("--isoline-step", support(Purpose::isolines, domain.kind()));  // it has isosurfaces
  check_output_name(options.out, domain.file().string(),
                    solid ? io::triangle_output_extensions() : io::path_extensions(),
                    "--isolines-out");
}

std::vector<double> isoline_values(const IsolineOptions& options,
                                   std::span<const double> distance) {
  if (options.out.empty()) return {};
  double most = 0;
  for (const double d : distance)
    if (std::isfinite(d)) most = std::max(most, d);
  if (most / *options.step > 10000)
    throw UsageError("--isoline-step: that would be more than 10000 values; take a larger step");
  std::vector<double> values;
  for (int n = 1; n * *options.step < most; ++n) values.push_back(n * *options.step);
  const std::string extension = io::lower_extension(options.out);
  if (values.empty() && (extension == ".glb" || extension == ".gltf"))
    throw UsageError("--isolines-out " + options.out + ": would hold nothing, which a " +
                     extension + " cannot: no distance is as large as the step");
  return values;
}

void write_isolines(const IsolineOptions& options, const Domain& shown, const AnyDomain& domain,
                    const AnyField& field, const AnyPathField* paths,
                    std::span<const double> values) {
  if (const auto* solid = std::get_if<io::Tets>(&shown.data()))
    return write_isosurfaces(options.out, *solid, field.doubles(), values);
  constexpr double share = 1e-3;  // of the step, which no eye sees
  const std::vector<Path> lines =
      paths != nullptr           ? isolines(shown, *paths, values, share * *options.step)
      : shown.cloud() != nullptr ? isolines(domain, field, values)
                                 : shown.isolines(field.doubles(), values);
  io::write_isolines(options.out, lines, values);
}

}  // namespace plexway::cli
