#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <plexway/any_domain.hpp>
#include <plexway/error.hpp>

#include "shape/arguments/arguments.hpp"
#include "shape/errors/measures.hpp"
#include "shape/info/error_classes.hpp"
#include "shape/info/report.hpp"
#include "shape/info/solve_words.hpp"
#include "tool/app.hpp"
#include "tool/options/input.hpp"
#include "tool/options/solve_options.hpp"
#include "tool/report/console.hpp"

namespace plexway::detail::cli {
namespace {

struct BenchCommand : InputCommand {
  std::vector<std::string> sources;
  std::vector<std::string> truths;
  std::size_t repeats = 20;
  std::size_t random_sources = 0;
  SolveOptions solve;
  TriangulationArgument triangulation;
  bool anatomy = false;
};

struct BenchResult {
  double build = 0, dijkstra_build = 0;
  bool has_dijkstra = false;
  Executor executor;
  std::size_t sources = 0;
  RaceTimes times;
  ErrorGauge errors;
};

std::vector<std::vector<double>> read_truths(const BenchCommand& command, const Domain& domain) {
  std::vector<std::vector<double>> truths;
  for (const std::string& file : command.truths)
    truths.push_back(read_truth(file, domain.vertices()));
  return truths;
}

Json bench_json(const BenchCommand& command, const AnyDomain& solver, const AnyField& field,
                const BenchResult& result) {
  const Domain& domain = solver.shape();
  const double ns = median(result.times.plexway);
  const double dijkstra_ns = median(result.times.dijkstra);
  Json json;
  json["input"] = domain.file().string();
  json["kind"] = domain.kind_name();
  json["vertices"] = domain.vertices();
  json["simplices"] = solver.simplices();
  json["precision"] = precision_of(command.solve) == Precision::float32 ? "float" : "double";
  json["executor"] = executor_name(result.executor);
  json["threads"] = executor_threads(result.executor);
  json["visibility"] = command.solve.visibility;
  if (has_accuracies(domain.kind())) json["accuracy"] = json_of(field.accuracy());
  if (domain.kind() == DomainKind::surface) {
    json["triangulation"] = name_of(field.triangulation.done);
    json["flips"] = field.triangulation.flips;
  }
  json["sources"] = result.sources;
  json["repeats"] = command.repeats;
  json["seconds"]["load"] = domain.load_seconds();
  if (domain.mesh_seconds()) json["seconds"]["mesh"] = *domain.mesh_seconds();
  if (domain.neighbour_seconds()) json["seconds"]["neighbours"] = *domain.neighbour_seconds();
  json["seconds"]["build"] = result.build;
  if (domain.kind() == DomainKind::surface)
    json["seconds"]["triangulation"] = field.triangulation.seconds;
  json["seconds"]["dijkstra_build"] =
      result.has_dijkstra ? Json(result.dijkstra_build) : Json(nullptr);
  json["bytes_per_vertex"] =
      static_cast<double>(solver.bytes() + field.bytes()) / static_cast<double>(domain.vertices());
  json["ns_per_vertex"] = json_number(ns);
  json["dijkstra_ns_per_vertex"] = json_number(dijkstra_ns);
  json["ratio"] = json_number(ns / dijkstra_ns);
  json["mean"] = json_number(result.errors.mean());
  json["p99"] = json_number(result.errors.percentile(99));
  json["max"] = json_number(result.errors.max());
  json["most_below"] = json_number(result.errors.most_below());
  json["compared"] = result.errors.compared();
  json["mismatched_unreached"] = result.errors.mismatched_unreached();
  return json;
}

// The same object for people, a line a value.
std::string bench_text(const Json& json) {
  Table table;
  for (const auto& [key, value] : json.items()) {
    if (value.is_object()) continue;
    table.add(key, value.is_string()         ? value.get<std::string>()
                   : value.is_number_float() ? short_number(value.get<double>())
                   : value.is_null()         ? "-"
                                             : value.dump());
  }
  for (const auto& [key, value] : json["seconds"].items()) {
    if (!value.is_null()) table.add(key + " seconds", short_number(value.get<double>()));
  }
  return table.text();
}

void run_bench(const BenchCommand& command) {
  const PropagateOptions options = propagate_options(command.solve);
  const Precision precision = precision_of(command.solve);
  const Triangulation triangulation = triangulation_of(command.triangulation);
  const std::vector<SourceArgument> arguments = parse_sources(command.sources);
  if (command.truths.size() > arguments.size())
    throw UsageError("more --truth than --source: give one file for each source, in order");

  BenchResult result;
  ProgressLine progress(command.quiet);
  const Domain domain = load_domain(command, progress);
  std::vector<PointSource> sources = locate_sources(domain, arguments);
  const auto truths = read_truths(command, domain);
  if (command.anatomy && truths.empty())
    throw UsageError("--anatomy splits errors: give the exact distances with --truth");
  std::optional<ErrorClasses> anatomy;
  if (command.anatomy) require("--anatomy", support(Purpose::error_classes, domain.kind()));
  if (command.anatomy) anatomy.emplace(domain);

  progress.phase("building");
  check_triangulation(triangulation, domain);
  const AnyDomain solver(domain, {.precision = precision,
                                  .triangulation = triangulation,
                                  .threads = command.solve.executor.threads.value_or(0)});
  AnyField field;
  result.build = solver.build_seconds();
  const Stopwatch building_graph;
  const auto dijkstra = make_edge_dijkstra(domain, precision);
  result.dijkstra_build = building_graph.seconds();
  result.has_dijkstra = dijkstra != nullptr;

  result.executor = choose_executor(command.solve.executor, options, solver, 1);
  // Not timed; it also brings workspace and field to their size.
  progress.phase("comparing with the truth");
  std::vector<double> distance_from_first;
  for (std::size_t i = 0; i < sources.size(); ++i) {
    solver.solve(result.executor, sources[i], options, field);
    const std::vector<double> distance = field.doubles();
    if (i < truths.size()) result.errors.add(distance, truths[i]);
    if (i < truths.size() && anatomy)
      anatomy->add(distance, truths[i], domain.position(sources[i]));
    if (i == 0) distance_from_first = distance;
  }
  add_random_sources(sources, command.random_sources, distance_from_first);
  result.sources = sources.size();

  progress.phase("measuring");
  result.times = race(solver, field, dijkstra.get(), sources, result.executor, options,
                      command.repeats, [&](double share) { progress.done(share); });
  progress.clear();

  Json json = bench_json(command, solver, field, result);
  const std::string text = bench_text(json) + (anatomy ? "\n" + anatomy->text() : "");
  if (anatomy) json["anatomy"] = anatomy->json();
  write_output(command.json ? json_text(json) : text);
  flush_output();
  if (!result.has_dijkstra && !command.quiet)
    say_note("this build has no Boost.Graph, so there is no Dijkstra to compare with");
}

}  // namespace

void add_bench_command(CLI::App& tool, Action& action) {
  auto command = std::make_shared<BenchCommand>();
  CLI::App& app = *tool.add_subcommand(
      "bench", "Speed against Boost.Graph's Dijkstra, and error against truth");
  const OptionGroup add(app);
  add_inputs(app, *command);
  add("--source,-s", command->sources, "WHERE",
      "vertex:ID or point:X,Y,Z; repeat it to take turns between sources")
      ->required()
      ->allow_extra_args(false);
  add("--truth", command->truths, "FILE",
      "exact distances from the source in the same place: one a line, in\n"
      "vertex order; nan lines are skipped, inf means unreached")
      ->allow_extra_args(false);
  add("--random-sources", command->random_sources, "K",
      "take turns with K more vertices, always the same ones")
      ->check(CLI::Range(0, 1'000'000));
  add("--repeats", command->repeats, "N", "timed runs of each solver (default 20)")
      ->check(CLI::Range(1, 1'000'000));
  app.add_flag("--anatomy", command->anatomy,
               "split the errors: above and below exact, near the source, where\n"
               "fronts meet, by the shape of simplices, by curvature, in solids by how\n"
               "far the path is from straight; needs --truth");
  add_solve_options(app, command->solve, false);
  add_triangulation_option(app, command->triangulation);
  add_input_options(app, *command, "no notes, no progress");
  app.footer(
      "Examples:\n"
      "  plexway bench bunny.obj --source vertex:3160 --truth bunny.v3160.txt\n"
      "  plexway bench bunny.obj --source vertex:3160 --random-sources 10 --json\n"
      "  plexway bench part.obj --source vertex:0 --truth part.v0.txt --triangulation input\n"
      "  plexway bench bunny.obj --source vertex:3160 --truth bunny.v3160.txt --anatomy\n"
      "  plexway bench cavity.ele --source vertex:170 --truth cavity.v170.txt --anatomy\n"
      "  plexway bench vessels.obj --source vertex:0 --random-sources 10\n"
      "  plexway bench swiss.xyz --source vertex:0 --truth swiss.v0.txt --k 16");
  app.callback([command, &action] { action = [command] { run_bench(*command); }; });
}

}  // namespace plexway::detail::cli
