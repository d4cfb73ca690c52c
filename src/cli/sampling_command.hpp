#pragma once

#include <memory>
#include <string>
#include <type_traits>
#include <variant>

#include <plexway/error.hpp>
#include <plexway/propagate/distance_field.hpp>

#include "console.hpp"
#include "domain.hpp"
#include "fill_options.hpp"
#include "make_complex.hpp"
#include "picture_options.hpp"
#include "report.hpp"
#include "solve_options.hpp"

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
  FillOptions fill;
  CloudArguments cloud;
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
void with_complex(const Domain& domain, Precision precision, Use use) {
  with_file_name(domain, [&] {
    std::visit(
        [&](const auto& shape) {
          using Shape = std::decay_t<decltype(shape)>;
          const auto build = [&](auto real) {
            using Real = decltype(real);
            if constexpr (std::is_same_v<Shape, io::Edges>)
              throw InputError("is a wireframe: points are chosen on surfaces, solids and clouds");
            else {
              use(make_complex<Real>(shape));
            }
          };
          precision == Precision::single ? build(float{}) : build(double{});
        },
        domain.shape());
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
