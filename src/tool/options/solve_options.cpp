#include "tool/options/solve_options.hpp"

#include <CLI/CLI.hpp>
#include <charconv>
#include <cmath>
#include <initializer_list>
#include <string_view>
#include <utility>

#include <plexway/error.hpp>
#include <plexway/shape/support.hpp>
#include <plexway/support.hpp>

#include "shape/arguments/require.hpp"
#include "shape/tuning/policy_file.hpp"

namespace plexway::cli {
namespace {

template <class Value>
Value choose(std::string_view option, const std::string& typed,
             std::initializer_list<std::pair<std::string_view, Value>> choices) {
  std::string names;
  for (const auto& [name, value] : choices) {
    if (typed == name) return value;
    names.append(names.empty() ? "" : ", ").append(name);
  }
  throw UsageError(std::string(option) + " '" + typed + "': choose one of " + names);
}

}  // namespace

void add_accuracy_option(CLI::App& command, std::string& accuracy, const std::string& group) {
  CLI::Option* const option =
      command
          .add_option(
              "--accuracy", accuracy,
              "of surfaces, clouds and solids: accurate (default; mean errors below 1e-4 on\n"
              "surfaces), fast (a third of the time; 1e-3, single vertices far off), exact (in\n"
              "double; not of solids), or a mean error, as 1e-3")
          ->type_name("NAME|X");
  if (!group.empty()) option->group(group);
}

Accuracy accuracy_of(const std::string& typed) {
  if (typed.empty()) return Accuracy::usual();
  if (typed == "fast") return Accuracy::fast();
  if (typed == "accurate") return Accuracy::accurate();
  if (typed == "exact") return Accuracy::exact();
  double error = -1;
  const auto read = std::from_chars(typed.data(), typed.data() + typed.size(), error);
  if (read.ec != std::errc() || read.ptr != typed.data() + typed.size() ||
      !(error >= 0 && error < 1))
    throw UsageError("--accuracy '" + typed +
                     "': choose fast, accurate, exact, or a mean error from 0 to below 1");
  return Accuracy(error);
}

void add_solve_options(CLI::App& command, SolveOptions& options, bool bounded) {
  const std::string group = "How to solve";
  add_accuracy_option(command, options.accuracy, group);
  command
      .add_option("--visibility", options.visibility,
                  "when a line of sight counts: saddles (default), tuned, centroid, or\n"
                  "upper_bound (never below exact, up to a third above)")
      ->type_name("NAME")
      ->group(group);
  command
      .add_option("--table", options.table,
                  "the table of --visibility tuned, as 'plexway tune --out' writes it")
      ->type_name("FILE")
      ->group(group);
  command
      .add_option("--schedule", options.schedule,
                  "what propagates next: dual_queue (default), fifo or priority")
      ->each([&options](const std::string&) { options.schedule_given = true; })
      ->type_name("NAME")
      ->group(group);
  command.add_option("--step", options.step, "width of the dual queue in mean edges (default 1)")
      ->each([&options](const std::string&) { options.step_given = true; })
      ->type_name("X")
      ->group(group);
  if (bounded) {
    command.add_option("--radius", options.radius, "go no farther than this; beyond it is inf")
        ->type_name("R")
        ->group(group);
    command
        .add_option("--max-expansions", options.max_expansions,
                    "stop after N expansions; distances are then not final")
        ->check(CLI::NonNegativeNumber)  // CLI11 would read -1 as 2^64 - 1
        ->type_name("N")
        ->group(group);
  }
  command.add_option("--precision", options.precision, "float (default) or double")
      ->each([&options](const std::string&) { options.precision_given = true; })
      ->type_name("NAME")
      ->group(group);
  add_executor_options(command, options.executor, group);
}

PropagateOptions propagate_options(const SolveOptions& options) {
  PropagateOptions made;
  made.accuracy = accuracy_of(options.accuracy);
  made.visibility = choose<Visibility>("--visibility", options.visibility,
                                       {{"saddles", Visibility::saddles},
                                        {"tuned", Visibility::tuned},
                                        {"centroid", Visibility::centroid},
                                        {"upper_bound", Visibility::upper_bound}});
  if (!options.table.empty()) {
    if (made.visibility != Visibility::tuned)
      throw UsageError("--table goes with --visibility tuned");
    made.probe = read_probe_table(options.table);
  }
  made.schedule = choose<Schedule>("--schedule", options.schedule,
                                   {{"dual_queue", Schedule::dual_queue},
                                    {"fifo", Schedule::fifo},
                                    {"priority", Schedule::priority}});
  if (!(options.step > 0) || std::isinf(options.step))
    throw UsageError("--step must be a number greater than 0");
  if (options.step_given && made.schedule != Schedule::dual_queue)
    throw UsageError("--step goes with --schedule dual_queue");
  made.step = options.step;
  if (options.radius) {
    if (!(*options.radius >= 0)) throw UsageError("--radius must be a number >= 0");
    made.radius = *options.radius;
  }
  if (options.max_expansions) made.max_expansions = *options.max_expansions;
  check_executor(options.executor, made, options.precision != "double");
  return made;
}

Precision precision_of(const SolveOptions& options) {
  const Precision typed =
      choose<Precision>("--precision", options.precision,
                        {{"float", Precision::float32}, {"double", Precision::float64}});
  const Support support = support_of_windows({.executor = ExecutorKind::serial,
                                              .domain = DomainKind::surface,
                                              .dimension = 2,
                                              .single_precision = typed == Precision::float32,
                                              .accuracy = accuracy_of(options.accuracy).kind()});
  if (support.refusal() != Refusal::windows_float) return typed;
  if (options.precision_given) require("--precision float", support);
  return Precision::float64;
}

void add_triangulation_option(CLI::App& command, TriangulationArgument& argument) {
  command
      .add_option("--triangulation", argument.name,
                  "surfaces: which triangles to solve on: input, delaunay (the intrinsic\n"
                  "Delaunay triangulation of the vertices), refined (that, with a quarter more\n"
                  "vertices inside), or auto (default: what the shape of the input's triangles\n"
                  "calls for; 'plexway info' tells). Results are for the input's vertices")
      ->type_name("NAME")
      ->group("How to solve");
}

Triangulation triangulation_of(const TriangulationArgument& argument) {
  if (argument.name == "input") return Triangulation::input;
  if (argument.name == "delaunay") return Triangulation::delaunay;
  if (argument.name == "refined") return Triangulation::refined;
  if (argument.name == "auto") return Triangulation::automatic;
  throw UsageError("--triangulation '" + argument.name +
                   "': choose one of input, delaunay, refined, auto");
}

void check_triangulation(Triangulation wanted, const Domain& domain) {
  if (on_other_triangles(wanted))
    require("--triangulation", support(Purpose::triangulations, domain.kind()));
}

}  // namespace plexway::cli
