#pragma once

#include <memory>
#include <string>
#include <type_traits>
#include <variant>

#include <plexway/error.hpp>

#include "console.hpp"
#include "domain.hpp"
#include "fill_options.hpp"
#include "make_complex.hpp"
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
  FillOptions fill;
  bool json = false, quiet = false;
};

/// Adds INPUT, --out (which it describes), --as and so on.
void add_sampling_options(CLI::App& app, SamplingCommand& command, const char* out_help);

/// Throws UsageError where the precision does not exist.
Precision precision_of(const SamplingCommand& command);

/// Calls `use(complex)` with the surface or the solid; throws InputError for another kind.
template <class Use>
void with_complex(const Domain& domain, Precision precision, Use use) {
  with_file_name(domain, [&] {
    std::visit(
        [&](const auto& shape) {
          using Shape = std::decay_t<decltype(shape)>;
          const auto build = [&](auto real) {
            using Real = decltype(real);
            if constexpr (std::is_same_v<Shape, io::Triangles> || std::is_same_v<Shape, io::Tets>)
              use(make_complex<Real>(shape));
            else
              throw InputError("is no surface and no solid: points are chosen on those");
          };
          precision == Precision::single ? build(float{}) : build(double{});
        },
        domain.shape());
  });
}

/// The summary, as JSON or as a table, where it is wanted.
void print_summary(const SamplingCommand& command, const Json& json, const Table& table);

}  // namespace plexway::cli
