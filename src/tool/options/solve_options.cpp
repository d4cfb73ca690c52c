#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <variant>

#include <plexway/any_domain.hpp>
#include <plexway/error.hpp>
#include <plexway/shape/complex.hpp>
#include <plexway/shape/support.hpp>
#include <plexway/support.hpp>

#include "shape/arguments/arguments.hpp"
#include "shape/info/solve_words.hpp"
#include "shape/tuning/tuning.hpp"
#include "tool/options/solve_options.hpp"

namespace plexway::detail {

namespace {

/// So many simplices and so many sources are worth several threads.
constexpr std::size_t auto_simplices = 100'000, auto_sources = 64;
/// In pieces so many simplices are, from one source (bench executors: 1.4 to 1.7 times as fast).
constexpr std::size_t auto_in_pieces = 400'000;
/// By strings so many; where these have few bends threads change little.
constexpr std::size_t auto_by_strings = 20'000;

/// Is it a solid that strings solve, or a mixed domain with a solid in it?
bool by_strings(const AnyDomain& domain, const PropagateOptions& options) {
  return with_complex(domain, [&]<class C>(const C& complex) {
    if constexpr (requires { complex.pieces(); }) {
      const auto is_solid = [&](const auto& piece) {
        return std::holds_alternative<TetMesh<RealOf<C>>>(complex.complex(piece));
      };
      return std::any_of(complex.pieces().begin(), complex.pieces().end(), is_solid);
    } else {
      const auto cell = with(combination_of(complex, ExecutorKind::openmp), options);
      return domain.kind() == DomainKind::solid &&
             resolved(options.accuracy, cell) != Accuracy::fast();
    }
  });
}

/// Serial or `team`, whichever solves ONE field of so many sources sooner.
AnyExecutor fastest_executor(const AnyDomain& domain, std::size_t sources,
                             const PropagateOptions& options, const OpenMP& team) {
  if (!openmp_built() || options.schedule == Schedule::priority) return Serial{};
  const bool in_pieces = domain.kind() == DomainKind::surface ||
                         domain.kind() == DomainKind::cloud ||
                         domain.kind() == DomainKind::wireframe;
  const bool bounded =
      options.radius < PropagateOptions{}.radius ||
      options.max_expansions < PropagateOptions{}.max_expansions;  // fronts may stay short
  const bool pays = (in_pieces && domain.simplices() >= auto_in_pieces) ||
                    (domain.simplices() >= auto_by_strings && by_strings(domain, options));
  const bool many = in_pieces && domain.simplices() >= auto_simplices && sources >= auto_sources;
  if (!(pays || many) || bounded || team_size(team) < 2) return Serial{};
  // Several threads are not for all options.
  if (!domain.support(team, PointSource::at(0), options)) return Serial{};
  return team;
}

}  // namespace

}  // namespace plexway::detail

namespace plexway::detail::cli {
namespace {

bool is_built(const std::string& name) {
  const auto built = built_executors();
  return name == "auto" || std::find(built.begin(), built.end(), name) != built.end();
}

}  // namespace

void add_executor_options(CLI::App& command, ExecutorArgument& argument, const std::string& group) {
  const OptionGroup add(command, group);
  add("--executor", argument.name, "NAME",
      "what it runs on: serial (default), openmp, gl or auto (what is fastest\n"
      "for so many simplices and sources)");
  add("--threads", argument.threads, "N",
      "that build INPUT, and solve by openmp and auto (default: all cores)")
      ->check(CLI::Range(1, 1024));
  add("--device", argument.device, "N",
      "for gl: its number in 'plexway info --devices' (default: the first\n"
      "graphics processor)")
      ->check(CLI::Range(0, 1024));
}

ExecutorKind kind_of(const ExecutorArgument& argument) {
  return argument.name == "gl"       ? ExecutorKind::gl
         : argument.name == "openmp" ? ExecutorKind::openmp
                                     : ExecutorKind::serial;
}

void check_executor(const ExecutorArgument& argument, const PropagateOptions& options,
                    bool single_precision) {
  const std::string& name = argument.name;
  const bool device = choose<bool>(
      "--executor", name, {{"serial", false}, {"openmp", false}, {"gl", true}, {"auto", false}});
  if (!is_built(name))
    throw NotBuiltError("--executor " + name + ": not built in; see 'plexway info --devices'");
  if (argument.device && !device) throw UsageError("--device needs --executor gl");
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

void add_metric_option(CLI::App& command, MetricArgument& argument) {
  const OptionGroup add(command, "How to solve");
  add("--metric", argument.text, "KIND:FILE",
      "what a step costs: speed:FILE (a number a simplex), regions:FILE (a region of a\n"
      ".msh, .vtu or .vtk and its speed a line), tensor:FILE (xx xy xz yy yz zz a simplex;\n"
      "xx xy yy in the plane), vertex-tensor:FILE (a vertex) or\n"
      "lengths:FILE (vertex vertex length an edge); default: lengths in space");
}

void add_metric(const MetricArgument& argument, const MeasuredLengths* lengths,
                std::size_t refracting_edges, Summary& summary) {
  if (lengths == nullptr) return;
  summary.add("metric", argument.text,
              argument.text + (!lengths->speeds.empty() ? "; refracts where speeds change"
                               : refracting_edges > 0
                                   ? "; refracts at " + counted(refracting_edges, "edges")
                                   : ""));
  summary.json["refracting_edges"] = refracting_edges;
  summary.json["violated"] = lengths->violations.count;
}

void add_mask_option(CLI::App& command, MaskArgument& argument) {
  const OptionGroup add(command);
  add("--mask", argument.text, "WHAT",
      "where no path may go: vertices:FILE or simplices:FILE, a number (0-based) a\n"
      "line; a vertex closes the simplices about it; FILE:3,7 closes the vertices with\n"
      "these labels (.label.gii, .annot, .label, or one a line); regions:3,7 closes\n"
      "these regions of a .msh, .vtu or .vtk");
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
  const OptionGroup add(command, group);
  add("--accuracy", options.accuracy, "NAME|X",
      "of surfaces, clouds and solids: accurate (default; mean errors below 1e-4 on\n"
      "surfaces), fast (a third of the time; 1e-3, single vertices far off), exact (in\n"
      "double; not of solids), or a mean error, as 1e-3");
  add("--visibility", options.visibility, "NAME",
      "when a line of sight counts: saddles (default), tuned, centroid, or\n"
      "upper_bound (never below exact, up to a third above)");
  add("--table", options.table, "FILE",
      "the table of --visibility tuned, as 'plexway tune --out' writes it");
  add("--schedule", options.schedule, "NAME",
      "what propagates next: dual_queue (default), fifo or priority")
      ->each([&options](const std::string&) { options.schedule_given = true; });
  add("--step", options.step, "X", "width of the dual queue in mean edges (default 1)")
      ->each([&options](const std::string&) { options.step_given = true; });
  if (bounded) {
    add("--radius", options.radius, "R", "go no farther than this; beyond it is inf");
    command
        .add_option("--max-expansions", options.max_expansions,
                    "stop after N expansions; distances are then not final")
        ->check(CLI::NonNegativeNumber)  // CLI11 would read -1 as 2^64 - 1
        ->type_name("N")
        ->group(group);
  }
  add("--precision", options.precision, "NAME", "float (default) or double")
      ->each([&options](const std::string&) { options.precision_given = true; });
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
  const OptionGroup add(command, "How to solve");
  add("--triangulation", argument.name, "NAME",
      "surfaces: which triangles to solve on: input, delaunay (the intrinsic\n"
      "Delaunay triangulation of the vertices), refined (that, with a quarter more\n"
      "vertices inside), or auto (default: what the shape of the input's triangles\n"
      "calls for; 'plexway info' tells). Results are for the input's vertices");
}

Triangulation triangulation_of(const TriangulationArgument& argument) {
  return choose<Triangulation>("--triangulation", argument.name,
                               {{"input", Triangulation::input},
                                {"delaunay", Triangulation::delaunay},
                                {"refined", Triangulation::refined},
                                {"auto", Triangulation::automatic}});
}

void check_triangulation(Triangulation wanted, const Domain& domain) {
  if (on_other_triangles(wanted))
    require("--triangulation", support(Purpose::triangulations, domain.kind()));
}

}  // namespace plexway::detail::cli
