#pragma once

#include <cstddef>
#include <optional>
#include <string>

#include <plexway/any_domain.hpp>
#include <plexway/executors.hpp>
#include <plexway/shape/field.hpp>
#include <plexway/solve/options.hpp>

#include "shape/arguments/arguments.hpp"
#include "shape/info/report.hpp"
#include "shape/info/solve_words.hpp"
#include "tool/options/input.hpp"
#include "tool/report/summary.hpp"

namespace plexway::detail::cli {
/// --executor, --threads and --device, as typed.
struct ExecutorArgument {
  std::string name = "serial";
  std::optional<int> threads;
  std::optional<int> device;
};

/// What runs a propagation.
using Executor = AnyExecutor;

void add_executor_options(CLI::App& command, ExecutorArgument& argument, const std::string& group);

/// The row of the table of what is supported. For `auto` that of Serial: whatever is requested,
/// `auto` may choose it.
[[nodiscard]] ExecutorKind kind_of(const ExecutorArgument& argument);

/// Throws UsageError for an executor that does not exist or cannot do what the options ask for, and
/// NotBuiltError for one that this build lacks. Before anything is read.
void check_executor(const ExecutorArgument& argument, const PropagateOptions& options,
                    bool single_precision);

/// Who solves: `auto` chooses by size, of those who can (docs/reference/cli.md). `sources` start
/// one field.
[[nodiscard]] Executor choose_executor(const ExecutorArgument& argument,
                                       const PropagateOptions& options, const AnyDomain& domain,
                                       std::size_t sources);

/// Adds --metric to a command.
void add_metric_option(CLI::App& command, MetricArgument& argument);

/// What a summary says: the metric, edges that refract, simplices whose lengths no triangle or
/// tetrahedron has. `lengths` may be null: nothing then.
void add_metric(const MetricArgument& argument, const MeasuredLengths* lengths,
                std::size_t refracting_edges, Summary& summary);

/// Adds --mask to a command.
void add_mask_option(CLI::App& command, MaskArgument& argument);

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

/// As typed; the usual one where nothing was. Throws UsageError.
Accuracy accuracy_of(const std::string& typed);

/// Throw UsageError for a value that does not exist or is out of range; the first also as
/// check_executor and read_probe_table. What is exact is double.
PropagateOptions propagate_options(const SolveOptions& options);
Precision precision_of(const SolveOptions& options);

/// As typed.
struct TriangulationArgument {
  std::string name = "auto";
};

/// Adds --triangulation to a command, in the group of the options that say how to solve.
void add_triangulation_option(CLI::App& command, TriangulationArgument& argument);

/// Throws UsageError for a name that does not exist.
Triangulation triangulation_of(const TriangulationArgument& argument);

/// Throws UsageError where `delaunay` or `refined` is asked of what is no surface.
void check_triangulation(Triangulation wanted, const Domain& domain);

}  // namespace plexway::detail::cli
