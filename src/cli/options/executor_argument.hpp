#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include <plexway/any_domain.hpp>
#include <plexway/executors.hpp>
#include <plexway/propagate/options.hpp>

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
/// Its name on the command line, and the number of its threads.
[[nodiscard]] std::string_view executor_name(const Executor& executor);
[[nodiscard]] std::size_t executor_threads(const Executor& executor);

/// Names of the executors in this build.
[[nodiscard]] std::vector<std::string_view> built_executors();

void add_executor_options(CLI::App& command, ExecutorArgument& argument, const std::string& group);

/// Throws UsageError for an executor that does not exist or cannot do what the options ask for, and
/// NotBuiltError for one that this build lacks. Before anything is read.
void check_executor(const ExecutorArgument& argument, const PropagateOptions& options);

/// Who solves: `auto` chooses by size, of those who can (docs/CLI.md). `sources` start one field.
[[nodiscard]] Executor choose_executor(const ExecutorArgument& argument,
                                       const PropagateOptions& options, const AnyDomain& domain,
                                       std::size_t sources);

}  // namespace plexway::cli
