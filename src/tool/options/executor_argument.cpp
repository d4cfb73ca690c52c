#include "tool/options/executor_argument.hpp"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>

#include <plexway/error.hpp>
#include <plexway/support.hpp>

#include "shape/arguments/require.hpp"
#include "shape/fastest_executor.hpp"
#include "shape/info/solve_words.hpp"

namespace plexway::cli {
namespace {

constexpr std::array<std::string_view, 4> names = {"serial", "openmp", "gl", "auto"};

bool is_built(const std::string& name) {
  const auto built = built_executors();
  return name == "auto" || std::find(built.begin(), built.end(), name) != built.end();
}

}  // namespace

void add_executor_options(CLI::App& command, ExecutorArgument& argument, const std::string& group) {
  command
      .add_option("--executor", argument.name,
                  "what it runs on: serial (default), openmp, gl or auto (what is fastest\n"
                  "for so many simplices and sources)")
      ->type_name("NAME")
      ->group(group);
  command
      .add_option("--threads", argument.threads,
                  "that build INPUT, and solve by openmp and auto (default: all cores)")
      ->check(CLI::Range(1, 1024))
      ->type_name("N")
      ->group(group);
  command
      .add_option("--device", argument.device,
                  "for gl: its number in 'plexway info --devices' (default: the first\n"
                  "graphics processor)")
      ->check(CLI::Range(0, 1024))
      ->type_name("N")
      ->group(group);
}

ExecutorKind kind_of(const ExecutorArgument& argument) {
  return argument.name == "gl"       ? ExecutorKind::gl
         : argument.name == "openmp" ? ExecutorKind::openmp
                                     : ExecutorKind::serial;
}

void check_executor(const ExecutorArgument& argument, const PropagateOptions& options,
                    bool single_precision) {
  const std::string& name = argument.name;
  if (std::find(names.begin(), names.end(), name) == names.end())
    throw UsageError("--executor '" + name + "': choose one of serial, openmp, gl, auto");
  if (!is_built(name))
    throw NotBuiltError("--executor " + name + ": not built in; see 'plexway info --devices'");
  if (argument.device && name != "gl") throw UsageError("--device needs --executor gl");
  if (name != "openmp" && name != "gl") return;
  // What any domain would refuse: no need to read one.
  const Support found = support({.executor = kind_of(argument),
                                 .domain = DomainKind::surface,
                                 .dimension = 2,
                                 .single_precision = single_precision,
                                 .visibility = options.visibility,
                                 .schedule = options.schedule,
                                 .accuracy = options.accuracy.kind()});
  for (const Refusal any :
       {Refusal::order, Refusal::gl_visibility, Refusal::windows_gl, Refusal::gl_double})
    if (found.refusal() == any) require("--executor " + name, found);
}

Executor choose_executor(const ExecutorArgument& argument, const PropagateOptions& options,
                         const AnyDomain& domain, std::size_t sources) {
  const OpenMP team{.threads = argument.threads.value_or(0)};
  if (argument.name == "openmp") return team;
  if (argument.name == "gl") return GL{.device = argument.device.value_or(-1)};
  return argument.name == "auto" ? fastest_executor(domain, sources, options, team) : Serial{};
}

}  // namespace plexway::cli
