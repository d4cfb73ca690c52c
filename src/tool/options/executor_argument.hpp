#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include <plexway/any_domain.hpp>
#include <plexway/executors.hpp>
#include <plexway/solve/options.hpp>

namespace CLI {
class App;
}

namespace plexway::cli {

/// --executor, --threads and --device, as typed.
struct ExecutorArgument {
  std::string name = "serial";
  std::optional<int> threads;
  std::optional<int> device;
};

/// What runs a propagation.
using Executor = AnyExecutor;

void add_executor_options(CLI::App& command, ExecutorArgument& argument, const std::string& group);

/// The row of the table of what goes together. For `auto` that of Serial: whatever is asked for,
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

}  // namespace plexway::cli
