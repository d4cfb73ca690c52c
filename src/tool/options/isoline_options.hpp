#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include <plexway/any_domain.hpp>

#include "tool/options/input.hpp"

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

/// Each multiple of the step below the largest distance, but 0; none where none are asked for.
/// Throws UsageError for more than 10000, and for none where the file cannot be empty.
std::vector<double> isoline_values(const IsolineOptions& options, std::span<const double> distance);

}  // namespace plexway::cli
