#pragma once

#include <string>
#include <type_traits>

#include <plexway/error.hpp>
#include <plexway/propagate/distance_field.hpp>

#include <plexway/any/complex.hpp>
#include "any/info/report.hpp"
#include "cli/options/fill_options.hpp"
#include "cli/options/input.hpp"
#include "cli/options/picture_options.hpp"
#include "cli/options/solve_options.hpp"
#include "cli/report/console.hpp"

namespace CLI {
class App;
}

namespace plexway::cli {

/// What the commands that choose points have in common, as typed.
struct SamplingCommand {
  std::string input, as, out;
  std::string precision = "float";
  bool precision_given = false;
  std::string accuracy;  ///< where the command has the option
  FillArguments fill;
  CloudPreparation cloud;
  PictureArguments picture;
  bool json = false, quiet = false;
};

/// Adds INPUT, --out (which it describes), --as and so on.
void add_sampling_options(CLI::App& app, SamplingCommand& command, const char* out_help);

/// Throws UsageError where the precision does not exist.
Precision precision_of(const SamplingCommand& command);

/// Calls `use(complex)` with the surface, the solid or the cloud; throws InputError for another
/// kind.
template <class Use>
void with_sampled(const Domain& domain, Precision precision, Use use) {
  if (domain.kind() == DomainKind::wireframe)
    throw InputError(domain.file().string() +
                     ": is a wireframe: points are chosen on surfaces, solids and clouds");
  const AnyDomain built(domain, {.precision = precision, .triangulation = Triangulation::input});
  with_complex(built, [&](const auto& complex) {
    constexpr DomainKind kind = std::decay_t<decltype(complex)>::kind;
    if constexpr (kind == DomainKind::surface || kind == DomainKind::solid ||
                  kind == DomainKind::cloud)
      use(complex);
    else
      throw InputError(domain.file().string() +
                       ": points are chosen on surfaces, solids and clouds");
  });
}

/// A summary of so many points: what the commands say first, and what they say last.
struct PointSummary {
  Json json;
  Table table;

  PointSummary(const SamplingCommand& command, const Domain& domain, std::size_t points);
  void finish(const SamplingCommand& command, const PropagateStatistics& work, double seconds);
};

/// The summary, as JSON or as a table, where it is wanted.
void print_summary(const SamplingCommand& command, const Json& json, const Table& table);

}  // namespace plexway::cli
