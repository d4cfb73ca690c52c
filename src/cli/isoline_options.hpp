#pragma once

#include <optional>
#include <span>
#include <string>

#include "domain.hpp"

namespace CLI {
class App;
}

namespace plexway::cli {

/// --isoline-step and --isolines-out, as typed.
struct IsolineOptions {
  std::string out;
  std::optional<double> step;
};

void add_isoline_options(CLI::App& command, IsolineOptions& options);

/// Before any work: throws UsageError for one without the other, a step that is not > 0, or as
/// check_output_name. Then, for a domain that is neither surface nor solid, or an extension that is
/// not for it.
void check_isolines(const IsolineOptions& options, const std::string& input);
void check_isolines(const IsolineOptions& options, const Domain& domain);

/// Lines at each multiple of the step, but 0; in a solid triangles. Throws as io::write_paths and
/// io::write_triangles, and UsageError for more than 10000 values.
void write_isolines(const IsolineOptions& options, const Domain& domain,
                    std::span<const double> distance);

}  // namespace plexway::cli
