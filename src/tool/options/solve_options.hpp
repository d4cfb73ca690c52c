#pragma once

#include <optional>
#include <string>

#include <plexway/shape/field.hpp>
#include <plexway/solve/options.hpp>

#include "tool/options/executor_argument.hpp"

namespace CLI {
class App;
}

namespace plexway::cli {

/// The options that say how to solve, as typed.
struct SolveOptions {
  std::string accuracy;  ///< empty: the usual one
  std::string visibility = "saddles";
  std::string table;
  std::string schedule = "dual_queue";
  double step = PropagateOptions{}.step;
  std::optional<double> radius;
  std::optional<std::size_t> max_expansions;
  std::string precision = "float";
  bool schedule_given = false, step_given = false, precision_given = false;
  ExecutorArgument executor;
};

/// Adds the options to a command; `bounded` adds those that end a propagation early.
void add_solve_options(CLI::App& command, SolveOptions& options, bool bounded);

/// Adds --accuracy alone.
void add_accuracy_option(CLI::App& command, std::string& accuracy, const std::string& group);
/// As typed; the usual one where nothing was. Throws UsageError.
Accuracy accuracy_of(const std::string& typed);

/// Throw UsageError for a value that does not exist or is out of range; the first also as
/// check_executor and read_probe_table. What is exact is double.
PropagateOptions propagate_options(const SolveOptions& options);
Precision precision_of(const SolveOptions& options);

}  // namespace plexway::cli
