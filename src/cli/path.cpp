#include <CLI/CLI.hpp>
#include <array>
#include <memory>
#include <span>
#include <string>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

#include <plexway/apps/path_field.hpp>
#include <plexway/apps/path_search.hpp>
#include <plexway/error.hpp>
#include <plexway/executors/serial.hpp>
#include <plexway/executors/serial_solid.hpp>
#include <plexway/executors/serial_wireframe.hpp>
#include <plexway/io/paths.hpp>

#include "commands.hpp"
#include "console.hpp"
#include "distance_output.hpp"
#include "domain.hpp"
#include "exit_codes.hpp"
#include "make_complex.hpp"
#include "progress.hpp"
#include "report.hpp"
#include "solve_options.hpp"
#include "source_argument.hpp"

namespace plexway::cli {
namespace {

struct PathCommand {
  std::string input;
  std::string as;
  std::vector<std::string> from, to;
  std::string out;
  FillOptions fill;
  SolveOptions solve;
  bool astar = false;
  bool json = false;
  bool quiet = false;
};

struct Outcome {
  std::vector<Path> paths;
  PropagateStatistics statistics;
  double build = 0, solve = 0, trace = 0;
};

template <class Real, class Shape>
Outcome find_paths(const Shape& shape, const PathCommand& command,
                   const std::vector<PointSource>& sources, const std::vector<PointSource>& targets,
                   const PropagateOptions& options, ProgressLine& progress) {
  Outcome outcome;
  progress.phase("building");
  const Stopwatch building;
  const auto complex = make_complex<Real>(shape);
  outcome.build = building.seconds();
  const Stopwatch solving;
  if constexpr (std::is_same_v<Shape, io::Triangles>) {
    if (command.astar) {
      PathSearch<Real> search(complex, shape.positions);
      progress.phase("searching");
      SearchOptions search_options;
      search_options.progress = progress.callback();
      SearchResult found = search.find(Serial{}, sources, targets, search_options);
      outcome.paths = std::move(found.paths);
      outcome.statistics = found.statistics;
      outcome.solve = solving.seconds();
      return outcome;
    }
  }
  progress.phase("solving");
  std::span<const std::array<double, 3>> positions = shape.positions;
  // Lengths of their own are not those between positions.
  if constexpr (std::is_same_v<Shape, io::Edges>)
    if (!shape.lengths.empty()) positions = {};
  PathField field(complex, positions);
  PropagateOptions with_progress = options;
  with_progress.progress = progress.callback();
  field.solve(Serial{}, std::span<const PointSource>(sources), with_progress);
  outcome.solve = solving.seconds();
  outcome.statistics = field.distances().statistics;
  progress.phase("tracing");
  const Stopwatch tracing;
  for (const PointSource& target : targets) outcome.paths.push_back(field.trace(target));
  outcome.trace = tracing.seconds();
  return outcome;
}

Json to_json(const PathCommand& command, const Domain& domain, const Outcome& outcome) {
  Json json;
  json["input"] = command.input;
  json["kind"] = domain.kind();
  json["vertices"] = domain.vertices();
  json["simplices"] = domain.simplices();
  json["paths"] = Json::array();
  for (std::size_t k = 0; k < outcome.paths.size(); ++k) {
    const Path& path = outcome.paths[k];
    Json one;
    one["to"] = command.to[k];
    one["from"] = path.source == none ? Json() : Json(command.from[path.source]);
    one["length"] = json_number(path.length);
    one["points"] = path.points.size();
    json["paths"].push_back(one);
  }
  json["seconds"]["load"] = domain.load_seconds();
  if (domain.mesh_seconds()) json["seconds"]["mesh"] = *domain.mesh_seconds();
  json["seconds"]["build"] = outcome.build;
  json["seconds"]["solve"] = outcome.solve;
  json["seconds"]["trace"] = outcome.trace;
  json["expansions"] = outcome.statistics.expansions;
  json["updates"] = outcome.statistics.updates;
  json["executor"] = "serial";
  return json;
}

std::string to_text(const PathCommand& command, const Domain& domain, const Outcome& outcome) {
  Table table;
  table.add("input", command.input);
  table.add(std::string(domain.kind()), counted(domain.vertices(), "vertices") + ", " +
                                            counted(domain.simplices(), domain.simplex_name()));
  for (std::size_t k = 0; k < outcome.paths.size(); ++k) {
    const Path& path = outcome.paths[k];
    table.add(outcome.paths.size() == 1 ? "path" : "path " + std::to_string(k),
              path.source == none
                  ? command.to[k] + " is not reached"
                  : command.to[k] + " to " + command.from[path.source] + ": length " +
                        short_number(path.length) + ", " + counted(path.points.size(), "points"));
  }
  table.add("work", counted(outcome.statistics.expansions, "expansions"));
  table.add("time", "load " + short_time(domain.load_seconds()) + ", build " +
                        short_time(outcome.build) + ", solve " + short_time(outcome.solve) +
                        ", trace " + short_time(outcome.trace));
  if (!command.out.empty()) table.add("written", command.out);
  return table.text();
}

void run_path(const PathCommand& command) {
  const PropagateOptions options = propagate_options(command.solve);
  const Precision precision = precision_of(command.solve);
  if (command.solve.executor.name != "serial" && command.solve.executor.name != "auto")
    throw UsageError("--executor '" + command.solve.executor.name +
                     "': paths are traced on what one thread leaves; choose serial");
  const std::vector<SourceArgument> from = parse_sources(command.from, "from");
  const std::vector<SourceArgument> to = parse_sources(command.to, "to");
  check_output_name(command.out, command.input, io::path_extensions());
  if (command.astar && options.visibility != Visibility::saddles)
    throw UsageError("--astar knows the default visibility only");

  ProgressLine progress(command.quiet);
  const Domain domain = Domain::load(command.input, command.as, command.fill, {}, progress);
  if (domain.cloud() != nullptr)
    throw InputError(command.input + ": is a cloud of points: paths need a mesh or a wireframe");
  if (command.astar && domain.kind() != "surface")
    throw UsageError("--astar: a " + std::string(domain.kind()) +
                     " is solved as a whole; A* is for surfaces");
  const std::vector<PointSource> sources = locate_sources(domain, from);
  const std::vector<PointSource> targets = locate_sources(domain, to);
  const Outcome outcome = with_file_name(domain, [&] {
    return std::visit(
        [&](const auto& shape) {
          if constexpr (std::is_same_v<std::decay_t<decltype(shape)>, Cloud>)
            return Outcome();
          else if (precision == Precision::single)
            return find_paths<float>(shape, command, sources, targets, options, progress);
          else
            return find_paths<double>(shape, command, sources, targets, options, progress);
        },
        domain.shape());
  });
  if (!command.out.empty()) {
    progress.phase("writing " + command.out);
    io::write_paths(command.out, outcome.paths);
  }
  progress.clear();
  if (command.json)
    write_output(json_text(to_json(command, domain, outcome)));
  else if (!command.quiet)
    write_output(to_text(command, domain, outcome));
  flush_output();

  std::size_t unreached = 0;
  for (const Path& path : outcome.paths) unreached += path.source == none;
  if (unreached == outcome.paths.size())
    throw NothingReached(command.input + ": nothing reached: no path leads to any target");
  if (unreached > 0 && !command.quiet)
    say_note(counted(unreached, "targets") + " not reached: no path leads there");
}

}  // namespace

void add_path_command(CLI::App& tool, Action& action) {
  auto command = std::make_shared<PathCommand>();
  CLI::App& app = *tool.add_subcommand("path", "Shortest paths from sources to targets");
  app.add_option("INPUT", command->input, input_help)->type_name("FILE")->required();
  app.add_option("--from,-f", command->from,
                 "vertex:ID (0-based, file order) or point:X,Y,Z (closest point of the\n"
                 "domain); repeat it for several sources, paths then lead to the nearest")
      ->required()
      ->type_name("WHERE")
      ->allow_extra_args(false);
  app.add_option("--to,-t", command->to, "the same; repeat it for several targets, a path each")
      ->required()
      ->type_name("WHERE")
      ->allow_extra_args(false);
  app.add_option("--out,-o", command->out,
                 "write the paths: .obj (lines), .ply, .vtp or .json by extension, each from its\n"
                 "target back to its source")
      ->type_name("FILE");
  app.add_option("--as", command->as, as_help)->type_name("KIND");
  app.add_flag("--astar", command->astar,
               "surfaces: look only at what a shortest path may pass, instead of everything");
  app.add_flag("--json", command->json, "print the summary as one JSON object");
  app.add_flag("--quiet,-q", command->quiet, "no summary, notes or progress; errors stay");
  add_solve_options(app, command->solve, false);
  add_fill_options(app, command->fill);
  app.footer(
      "Examples:\n"
      "  plexway path knot.ply --from vertex:0 --to vertex:99 --out path.obj\n"
      "  plexway path knot.ply --from vertex:0 --to vertex:99 --to point:1,0,0 --astar --json\n"
      "  plexway path organ.off --as solid --from point:0,0,0 --to point:1,1,0 -o path.vtp");
  app.callback([command, &action] { action = [command] { run_path(*command); }; });
}

}  // namespace plexway::cli
