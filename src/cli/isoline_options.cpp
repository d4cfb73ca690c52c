#include "isoline_options.hpp"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <variant>
#include <vector>

#include <plexway/apps/isolines.hpp>
#include <plexway/io/paths.hpp>

#include "distance_output.hpp"

namespace plexway::cli {

void add_isoline_options(CLI::App& command, IsolineOptions& options) {
  command
      .add_option("--isoline-step", options.step,
                  "surfaces: lines at each multiple of this distance, for --isolines-out")
      ->type_name("STEP");
  command.add_option("--isolines-out", options.out, "where to: .obj (lines), .ply, .vtp or .json")
      ->type_name("FILE");
}

void check_isolines(const IsolineOptions& options, const std::string& input) {
  if (options.out.empty() != !options.step)
    throw UsageError("--isoline-step STEP and --isolines-out FILE go together");
  if (options.step && !(*options.step > 0 && std::isfinite(*options.step)))
    throw UsageError("--isoline-step: the step must be > 0");
  check_output_name(options.out, input, io::path_extensions(), "--isolines-out");
}

void check_isolines(const IsolineOptions& options, const Domain& domain) {
  if (!options.out.empty() && domain.kind() != "surface")
    throw UsageError("--isoline-step: for surfaces, not a " + std::string(domain.kind()));
}

void write_isolines(const IsolineOptions& options, const Domain& domain,
                    std::span<const double> distance) {
  double most = 0;
  for (const double d : distance)
    if (std::isfinite(d)) most = std::max(most, d);
  if (most / *options.step > 10000)
    throw UsageError("--isoline-step: that would be more than 10000 values; take a larger step");
  std::vector<double> values;
  for (int n = 1; n * *options.step < most; ++n) values.push_back(n * *options.step);
  const auto& surface = std::get<io::Triangles>(domain.shape());
  io::write_paths(options.out, isolines(surface.positions, surface.triangles, distance, values));
}

}  // namespace plexway::cli
