#include <algorithm>
#include <cmath>
#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <plexway/any_domain.hpp>
#include <plexway/error.hpp>
#include <plexway/io/paths.hpp>
#include <plexway/shape/search.hpp>
#include <plexway/shape/support.hpp>
#include <plexway/shape/warnings.hpp>

#include "io/number_rows.hpp"
#include "shape/arguments/arguments.hpp"
#include "shape/info/solve_words.hpp"
#include "shape/shape_state.hpp"
#include "tool/app.hpp"
#include "tool/options/input.hpp"
#include "tool/options/picture_options.hpp"
#include "tool/options/solve_options.hpp"
#include "tool/report/console.hpp"
#include "tool/report/summary.hpp"

namespace plexway::detail::cli {
namespace {

struct PathCommand : InputCommand {
  std::vector<std::string> from, to;
  std::string out;
  SolveOptions solve;
  TraceOptions trace;
  PictureArguments picture;
  MaskArgument mask;
  MetricArgument metric;
  TriangulationArgument triangulation;
  bool astar = false;
};

// Points as they were requested, and where that is in the domain.
struct Places {
  std::vector<SourceArgument> asked;
  std::vector<PointSource> found;
};

struct PathOutcome {
  std::vector<Path> paths;
  std::vector<double> distance;  // none where only a part was searched
  std::vector<double> promised;  // of each target, as the field has it
  std::size_t simplices = 0;     // of a cloud those that it was made into
  TriangulationReport triangulation;
  PropagateStatistics statistics;
  std::vector<Warning> warnings;
  Accuracy accuracy = Accuracy::fast();
  std::string_view executor = "serial";
  double build = 0, solve = 0, trace = 0;
};

PathOutcome run_paths(const Domain& domain, const BuildOptions& building,
                      const PathCommand& command, const std::vector<PointSource>& sources,
                      const std::vector<PointSource>& targets, PropagateOptions options,
                      ProgressLine& progress) {
  PathOutcome outcome;
  progress.phase("building");
  const AnyDomain built(domain, building);
  outcome.build = built.build_seconds();
  outcome.simplices = built.simplices();
  outcome.warnings = domain_warnings(built, Reader::tool);
  const Stopwatch solving;
  if (command.astar) {
    progress.phase("searching");
    SearchResult found = find_paths(built, sources, targets,
                                    {.trace = command.trace, .progress = progress.callback()});
    outcome.paths = std::move(found.paths);
    outcome.promised = std::move(found.distance);
    outcome.statistics = found.statistics;
    outcome.solve = solving.seconds();
    return outcome;
  }
  progress.phase("solving");
  options.progress = progress.callback();
  const Executor executor = choose_executor(command.solve.executor, options, built, 1);
  outcome.executor = executor_name(executor);
  const AnyPathField field = built.path_field(executor, sources, options);
  outcome.solve = solving.seconds();
  outcome.statistics = field.field().statistics();
  outcome.accuracy = field.field().accuracy();
  outcome.triangulation = field.field().triangulation;
  outcome.distance = field.field().doubles();
  for (Warning& one : field_warnings(built, field.field(), sources, Reader::tool))
    outcome.warnings.push_back(std::move(one));
  progress.phase("tracing");
  const Stopwatch tracing;
  for (const PointSource& target : targets) {
    outcome.paths.push_back(field.trace(target, command.trace));
    const bool by_paths = built.kind() == DomainKind::mixed ||
                          (built.lengths() != nullptr && built.lengths()->refracts);
    const ReadOut level =
        outcome.accuracy == Accuracy::fast() && !by_paths ? ReadOut::linear : ReadOut::neighbours;
    outcome.promised.push_back(target.vertex == none ? field.at(target, level)
                                                     : outcome.distance[target.vertex]);
  }
  outcome.trace = tracing.seconds();
  return outcome;
}

// How far the point that was requested is from the domain, where one was.
Json snapped(const Domain& domain, const SourceArgument& asked, const PointSource& found) {
  const auto off = distance_from(domain, asked, found);
  return off ? Json(*off) : Json(nullptr);
}

double length_in_space(const Path& path) {
  double sum = 0;
  for (std::size_t i = 0; i + 1 < path.positions.size(); ++i) {
    const auto &p = path.positions[i], &q = path.positions[i + 1];
    sum += std::hypot(q[0] - p[0], q[1] - p[1], q[2] - p[2]);
  }
  return sum;
}

// What is printed: as JSON, and for people.
Summary summary_of(const PathCommand& command, const Domain& domain, const PathOutcome& outcome,
                   const Places& from, const Places& to) {
  Summary summary(command.input, domain.kind_name());
  Json& json = summary.json;
  Table& table = summary.table;
  json["vertices"] = domain.vertices();
  json["simplices"] = outcome.simplices;
  json["paths"] = Json::array();
  if (!command.metric.text.empty()) table.add("metric", command.metric.text);
  table.add(std::string(domain.kind_name()), size_text(domain, outcome.simplices));
  for (std::size_t k = 0; k < outcome.paths.size(); ++k) {
    const Path& path = outcome.paths[k];
    const bool reached = path.source != none;
    Json one;
    one["to"] = command.to[k];
    one["from"] = reached ? Json(command.from[path.source]) : Json();
    one["to_snapped"] = snapped(domain, to.asked[k], to.found[k]);
    one["from_snapped"] =
        reached ? snapped(domain, from.asked[path.source], from.found[path.source]) : Json();
    one["length"] = json_number(path.length);
    if (!command.metric.text.empty() && !path.positions.empty())
      one["length_in_space"] = length_in_space(path);
    one["distance"] = json_number(outcome.promised[k]);
    one["points"] = path.points.size();
    one["windows"] = path.windows;
    one["capped"] = path.capped;
    json["paths"].push_back(one);
    const auto place = [&](const Places& places, std::size_t n) {
      return std::holds_alternative<Index>(places.asked[n].where)
                 ? places.asked[n].text
                 : describe_source(domain, places.asked[n], places.found[n]);
    };
    table.add(outcome.paths.size() == 1 ? "path" : "path " + std::to_string(k),
              reached ? place(from, path.source) + " to " + place(to, k) + ": length " +
                            short_number(path.length) + ", " + counted(path.points.size(), "points")
                      : place(to, k) + " is not reached");
  }
  add_accuracy(domain.kind(), outcome.accuracy, outcome.statistics, json);
  if (!command.metric.text.empty()) json["metric"] = command.metric.text;
  summary.took_loading(domain);
  summary.took("build", outcome.build);
  summary.took("solve", outcome.solve);
  summary.took("trace", outcome.trace);
  json["expansions"] = outcome.statistics.expansions;
  json["updates"] = outcome.statistics.updates;
  json["executor"] = outcome.executor;
  if (domain.kind() == DomainKind::surface)
    json["triangulation"] = name_of(outcome.triangulation.done);
  if (command.verbose) table.add("work", counted(outcome.statistics.expansions, "expansions"));
  return summary;
}

// Things the user should know about paths that were found.
Notes path_notes_on(const PathOutcome& outcome, const std::vector<PointSource>& sources,
                    std::size_t unreached) {
  std::size_t capped = 0, apart = 0, none_long = 0;
  double most = 0;
  for (std::size_t k = 0; k < outcome.paths.size(); ++k) {
    const Path& path = outcome.paths[k];
    if (path.source == none) continue;
    capped += path.capped;
    none_long += path.length == 0;
    const double length = path.length + sources[path.source].offset;
    const double gap = length > 0 ? std::abs(outcome.promised[k] / length - 1) : 0;
    if (!(gap > 0.01) || !std::isfinite(gap)) continue;
    ++apart;
    most = std::max(most, gap);
  }
  Notes notes;
  notes.add(outcome.warnings);
  if (capped > 0)
    notes.add(counted(capped, "paths") +
              ": the search for a shorter one ended early, so there may be one");
  if (apart > 0)
    notes.add(counted(apart, "paths") + ": the length differs from the distance by up to " +
              short_number(100 * most) + " %: one of the two is off");
  if (none_long > 0)
    notes.add(counted(none_long, "paths") +
              ": both ends are in one place, so the length is 0; if they are not meant to be, are "
              "the units those of the file?");
  if (unreached > 0) notes.add(counted(unreached, "targets") + " not reached: there is no path");
  return notes;
}

// Each of vertices:FILE as the vertex that it is.
std::vector<std::string> one_by_one(const std::vector<std::string>& places) {
  constexpr std::string_view list = "vertices:";
  std::vector<std::string> single;
  for (const std::string& place : places) {
    if (place.substr(0, list.size()) != list) {
      single.push_back(place);
      continue;
    }
    const std::string file = place.substr(list.size());
    for (const io::NumberRow& row : io::read_number_rows(file, 1, 1, "a vertex (0-based) a line"))
      single.push_back("vertex:" + std::to_string(io::vertex_in(file, row, 0, none)));
  }
  return single;
}

// May A* search such a domain, by such options?
void check_search(DomainKind kind, const PathCommand& command, const PropagateOptions& options,
                  Triangulation triangulation) {
  require("--astar", support(Purpose::astar, {.executor = kind_of(command.solve.executor),
                                              .domain = kind,
                                              .dimension = 2,
                                              .single_precision = true,
                                              .visibility = options.visibility,
                                              .schedule = options.schedule,
                                              .accuracy = options.accuracy.kind(),
                                              .label_options = command.solve.step_given}));
  require("--astar", support(Purpose::astar, triangulation));
}

void run_path(const PathCommand& typed) {
  PathCommand command = typed;
  command.to = one_by_one(typed.to);
  const PropagateOptions options = propagate_options(command.solve);
  const Precision precision = precision_of(command.solve);
  const std::vector<SourceArgument> from = parse_sources(command.from, "from");
  const std::vector<SourceArgument> to = parse_sources(command.to, "to");
  check_output_name(command.out, command.input, io::path_extensions());
  if (const auto margin = command.trace.margin; margin && !(*margin >= 0 && *margin < 1))
    throw UsageError("--margin must be >= 0 and < 1");
  const Triangulation triangulation = triangulation_of(command.triangulation);
  if (command.astar) check_search(DomainKind::surface, command, options, triangulation);
  check_picture(command.picture, command.input);
  std::vector<std::string> read = {metric_file(command.metric), mask_file(command.mask),
                                   command.solve.table};
  read.insert(read.end(), command.more.begin(), command.more.end());
  check_output_place(command.out, read, "--out");
  check_outputs_differ({command.out, command.picture.file, command.picture.html});

  ProgressLine progress(command.quiet);
  const Domain domain = load_domain(command, progress);
  if (command.astar) check_search(domain.kind(), command, options, triangulation);
  check_triangulation(triangulation, domain);
  if (command.trace.margin) require("--margin", support(Purpose::margins, domain.kind()));
  const std::vector<PointSource> sources = locate_sources(domain, from);
  const std::vector<PointSource> targets = locate_sources(domain, to);
  if (!command.metric.text.empty()) progress.phase("reading the metric");
  // A* goes straight over an edge: it has one length.
  auto lengths = measure(command.metric, domain, command.astar ? Jumps::smooth : Jumps::refract);
  const std::shared_ptr<const Mask> mask = read_mask(command.mask, domain);
  require_open(mask.get(), domain, sources);
  require_open(mask.get(), domain, targets);
  PathOutcome outcome =
      run_paths(domain,
                {.precision = precision,
                 .triangulation = command.astar ? Triangulation::input : triangulation,
                 .lengths = lengths,
                 .mask = mask,
                 .threads = command.solve.executor.threads.value_or(0),
                 .progress = progress.share_callback()},
                command, sources, targets, options, progress);
  if (!command.out.empty()) {
    progress.phase("writing " + command.out);
    io::write_paths(command.out, outcome.paths);
  }
  if (command.picture.wanted()) {
    progress.phase("drawing " + command.picture.file);
    SceneContent content;
    content.distance = outcome.distance;
    content.look_inside = true;
    for (const Path& path : outcome.paths) content.paths.push_back(path.positions);
    if (!domain.positions().empty()) {
      for (const PointSource& source : sources) content.sources.push_back(domain.position(source));
      for (const PointSource& target : targets) content.targets.push_back(domain.position(target));
    }
    write_picture(command.picture, mask ? domain.open_part(*mask) : domain, content, command.quiet);
  }
  progress.clear();
  Summary summary = summary_of(command, domain, outcome, {from, sources}, {to, targets});
  report_picture(command.picture, domain, summary);
  std::size_t unreached = 0;
  for (const Path& path : outcome.paths) unreached += path.source == none;
  Notes notes;
  notes.add(far_notes(domain, from, sources));
  notes.add(far_notes(domain, to, targets));
  notes.add(path_notes_on(outcome, sources, unreached));
  summary.print(command, {command.out, command.picture.file, command.picture.html}, notes);
  if (unreached == outcome.paths.size())
    throw NothingReached(command.input + ": nothing reached: there is no path to any target");
  notes.say(command.quiet);
}

}  // namespace

void add_path_command(CLI::App& tool, Action& action) {
  auto command = std::make_shared<PathCommand>();
  CLI::App& app = *tool.add_subcommand("path", "Shortest paths from sources to targets");
  const OptionGroup add(app);
  add_inputs(app, *command);
  add("--from,-f", command->from, "WHERE",
      "vertex:ID (0-based, file order) or point:X,Y,Z (closest point of the\n"
      "domain); repeat it for several sources, paths then lead to the nearest")
      ->required()
      ->allow_extra_args(false);
  add("--to,-t", command->to, "WHERE",
      "the same, or vertices:FILE with one a line; repeat it for several targets, a\n"
      "path each")
      ->required()
      ->allow_extra_args(false);
  add_output(app, "--out,-o", command->out,
             "write the paths: .obj (lines), .ply, .vtp, .csv or .json by extension, each from\n"
             "its target back to its source; - for JSON on standard output",
             "json");
  app.add_flag("--astar", command->astar,
               "surfaces: look only at what a shortest path may pass, instead of everything");
  add("--margin", command->trace.margin, "X",
      "surfaces and clouds: the path is the shortest of all where distances are too long\n"
      "by no more than this share (default 0.003, on surfaces with --accuracy fast alone);\n"
      "0 is quicker, and locally shortest");
  add_solve_options(app, command->solve, false);
  add_triangulation_option(app, command->triangulation);
  add_metric_option(app, command->metric);
  add_mask_option(app, command->mask);
  add_picture_options(app, command->picture);
  add_input_options(app, *command);
  add_verbose_option(app, *command);
  app.footer(
      "Examples:\n"
      "  plexway path knot.ply --from vertex:0 --to vertex:99 --out path.obj\n"
      "  plexway path knot.ply --from vertex:0 --to vertex:99 --to point:1,0,0 --astar --json\n"
      "  plexway path knot.ply --from vertex:0 --to vertex:99 --picture path.png\n"
      "  plexway path organ.off --as solid --from vertex:0 --to vertex:9 -o path.vtp");
  app.callback([command, &action] { action = [command] { run_path(*command); }; });
}

}  // namespace plexway::detail::cli
