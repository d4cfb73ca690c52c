#include "cli/options/executor_argument.hpp"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>

#include <plexway/error.hpp>
#include <plexway/support.hpp>

#include "any/fastest_executor.hpp"

namespace plexway::cli {
namespace {

constexpr std::array<std::string_view, 4> names = {"serial", "openmp", "gl", "auto"};
#ifdef PLEXWAY_HAS_GL
constexpr bool gl_built = true;
#else
constexpr bool gl_built = false;
#endif

}  // namespace

std::string_view executor_name(const Executor& executor) { return names[executor.index()]; }

std::size_t executor_threads(const Executor& executor) {
  const OpenMP* const team = std::get_if<OpenMP>(&executor);
  return team == nullptr ? 1 : team_size(*team);
}

std::vector<std::string_view> built_executors() {
  std::vector<std::string_view> built = {"serial"};
  if (openmp_built()) built.push_back("openmp");
  if (gl_built) built.push_back("gl");
  return built;
}

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

void check_executor(const ExecutorArgument& argument, const PropagateOptions& options) {
  const std::string& name = argument.name;
  if (std::find(names.begin(), names.end(), name) == names.end())
    throw UsageError("--executor '" + name + "': choose one of serial, openmp, gl, auto");
  if ((name == "gl" && !gl_built) || (name == "openmp" && !openmp_built()))
    throw NotBuiltError("--executor " + name + ": not built in; see 'plexway info --devices'");
  if (argument.device && name != "gl") throw UsageError("--device needs --executor gl");
  if (name != "openmp" && name != "gl") return;
  // What any domain would refuse, in the words of the command line.
  const Refusal refusal =
      support({.executor = name == "gl" ? ExecutorKind::gl : ExecutorKind::openmp,
               .domain = DomainKind::surface,
               .dimension = 2,
               .single_precision = true,
               .visibility = options.visibility,
               .schedule = options.schedule,
               .accuracy = options.accuracy.kind()})
          .refusal();
  if (refusal == Refusal::order)
    throw UsageError("--schedule priority needs --executor serial: " + name +
                     " does not take labels in order");
  if (refusal == Refusal::gl_visibility)
    throw UsageError("--executor gl knows --visibility saddles only");
  if (refusal == Refusal::windows_gl)
    throw UsageError("--executor " + name + " knows --accuracy fast only");
}

Executor choose_executor(const ExecutorArgument& argument, const PropagateOptions& options,
                         const AnyDomain& domain, std::size_t sources) {
  const OpenMP team{.threads = argument.threads.value_or(0)};
  if (argument.name == "openmp") return team;
  if (argument.name == "gl") {
    if (domain.precision() == Precision::twice)
      throw UsageError("--executor gl computes in single precision: use --precision float");
    return GL{.device = argument.device.value_or(-1)};
  }
  return argument.name == "auto" ? fastest_executor(domain, sources, options, team) : Serial{};
}

}  // namespace plexway::cli
