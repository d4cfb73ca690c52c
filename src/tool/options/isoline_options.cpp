#include "tool/options/isoline_options.hpp"

#include <CLI/CLI.hpp>
#include <cmath>

#include <plexway/error.hpp>

#include "io/extension.hpp"
#include "shape/level_set_file.hpp"
#include "tool/report/distance_output.hpp"

namespace plexway::cli {

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
    throw UsageError("give --isoline-step STEP and --isolines-out FILE both");
  if (options.step && !(*options.step > 0 && std::isfinite(*options.step)))
    throw UsageError("--isoline-step: the step must be > 0");
  check_output_name(options.out, input, level_set_extensions(), "--isolines-out");
}

void check_isolines(const IsolineOptions& options, const Domain& domain) {
  if (options.out.empty()) return;
  check_output_name(options.out, domain.file().string(), level_set_extensions(domain.kind()),
                    "--isolines-out");
}

std::vector<double> isoline_values(const IsolineOptions& options,
                                   std::span<const double> distance) {
  if (options.out.empty()) return {};
  std::vector<double> values = level_set_values(distance, *options.step);
  const std::string extension = io::lower_extension(options.out);
  if (values.empty() && (extension == ".glb" || extension == ".gltf"))
    throw UsageError("--isolines-out " + options.out + ": would hold nothing, which a " +
                     extension + " cannot: no distance is as large as the step");
  return values;
}

}  // namespace plexway::cli
