#include <algorithm>
#include <array>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <plexway/any_domain.hpp>
#include <plexway/cloud/point_cloud.hpp>
#include <plexway/error.hpp>
#include <plexway/io/field.hpp>
#include <plexway/shape/open_simplices.hpp>
#include <plexway/shape/support.hpp>

#include "executors/same_work.hpp"
#include "io/field/field_formats.hpp"
#include "shape/arguments/arguments.hpp"
#include "shape/files/files.hpp"
#include "shape/info/info_report.hpp"
#include "shape/info/solve_words.hpp"
#include "shape/level_sets.hpp"
#include "shape/shape_state.hpp"
#include "shape/warnings/field_warnings.hpp"
#include "shape/warnings/sentences.hpp"
#include "shape/words.hpp"
#include "tool/app.hpp"
#include "tool/commands/distance_command.hpp"
#include "tool/report/console.hpp"
#include "tool/report/summary.hpp"

namespace plexway::detail::cli {
namespace {

// What came out, as far as a report tells it.
struct DistanceOutcome : FieldReach {
  double build = 0, solve = 0;
  Executor executor = {};
  RankCounts ranks = {};
};

// Where each source is in the domain, and how far from where it was requested.
Json sources_json(const Domain& domain, const std::vector<SetArgument>& arguments,
                  const std::vector<Source>& sources) {
  Json list = Json::array();
  for (std::size_t i = 0; i < sources.size(); ++i) {
    Json one;
    one["source"] = arguments[i].text;
    const auto* point = std::get_if<PointSource>(&sources[i]);
    if (const auto* ball = std::get_if<BallSource>(&sources[i])) point = &ball->centre;
    if (point != nullptr && point->vertex != none) one["vertex"] = point->vertex;
    if (point != nullptr && point->vertex == none) {
      one["simplex"] = point->simplex;
      one["barycentric"] = point->barycentric;
    }
    const AskedPoints asked =
        asked_points(std::span(arguments).subspan(i, 1), std::span(sources).subspan(i, 1));
    std::optional<double> snapped;
    for (std::size_t k = 0; k < asked.found.size(); ++k)
      if (const auto away = distance_from(domain, asked.asked[k], asked.found[k]))
        snapped = std::max(snapped.value_or(0), *away);
    one["snapped"] = snapped ? Json(*snapped) : Json(nullptr);
    list.push_back(one);
  }
  return list;
}

Summary summary_of(const DistanceCommand& command, const Domain& domain, const AnyDomain& solver,
                   const AnyField& field, const MeasuredLengths* lengths,
                   const std::vector<SetArgument>& arguments, const std::vector<Source>& sources,
                   const DistanceOutcome& outcome) {
  Summary summary(domain.file().string(), domain.kind_name());
  Json& json = summary.json;
  Table& table = summary.table;
  json["vertices"] = domain.vertices();
  json["simplices"] = solver.simplices();
  json["components"] = solver.components();
  table.add(std::string(domain.kind_name()), size_text(domain, solver.simplices()) + ", " +
                                                 counted(solver.components(), "components"));
  json["sources"] = sources_json(domain, arguments, sources);
  for (std::size_t i = 0; i < sources.size(); ++i)
    table.add(sources.size() == 1 ? "source" : "source " + std::to_string(i),
              describe_source_set(domain, arguments[i], sources[i]));
  add_metric(command.metric, lengths, solver.refracting_edges(), summary);
  if (field.triangulation.done != Triangulation::input)
    table.add("triangles", describe(field.triangulation));
  summary.took_loading(domain);
  summary.took("build", outcome.build);
  summary.took("solve", outcome.solve);
  summary.time_note(" (" + describe(outcome.executor) + ", " +
                    (has_accuracies(domain.kind()) ? name_of(field.accuracy()) + ", " : "") +
                    command.solve.precision + ")");
  DistanceReport{.vertices = domain.vertices(),
                 .reached = outcome.reached,
                 .farthest = static_cast<Index>(outcome.farthest),
                 .max_distance = outcome.max_distance,
                 .mean_distance = {},
                 .statistics = field.statistics(),
                 .ranks = command.among != nullptr ? command.among->ranks.count() : 0,
                 .counts = outcome.ranks,
                 .of_surface = domain.kind() == DomainKind::surface}
      .add_to(summary, command.verbose);
  json["executor"] = executor_name(outcome.executor);
  json["threads"] = executor_threads(outcome.executor);
  json["precision"] = command.solve.precision == "float" ? "float" : "double";
  add_accuracy(domain.kind(), field.accuracy(), field.statistics(), json);
  if (domain.kind() == DomainKind::surface)
    json["triangulation"] = name_of(field.triangulation.done);
  add_file_report(domain, json, table);
  if (!domain.level_set_note().empty())
    summary.add("voxels", domain.level_set_note(), domain.level_set_note());
  if (const CloudShape* cloud = domain.cloud()) {
    json["points_in_file"] = cloud->points_in_file;
    json["not_finite"] = cloud->not_finite;
    json["outliers"] = cloud->outliers;
    const auto dropped = dropped_points(*cloud);
    json["dropped"] = dropped ? Json(*dropped) : Json(nullptr);
    if (const std::string kept = kept_points(*cloud); !kept.empty()) table.add("kept", kept);
  }
  return summary;
}

// What there is to tell of a field; `options` are those that it was solved by.
Notes notes_on(const DistanceCommand& command, const AnyDomain& solver, const AnyField& field,
               const std::vector<Source>& sources, const PropagateOptions& options,
               const Executor& executor, bool isolines_are_empty) {
  Notes notes;
  if (command.quiet && !command.json) return notes;
  if (!command.isolines.out.empty() && isolines_are_empty)
    notes.add("--isolines-out holds nothing: no distance is as large as the step");
  // Who did not choose learns what was chosen, and what another choice would bring.
  if (std::holds_alternative<GL>(executor) && command.solve.accuracy.empty() &&
      has_accuracies(solver.kind()))
    notes.add("--executor gl knows --accuracy fast only; serial is more accurate");
  notes.add(warnings(solver, field, sources, options, Reader::tool));
  return notes;
}

void run_distance(DistanceCommand command) {
  if (command.among != nullptr)
    require("--executor " + command.solve.executor.name,
            support(Purpose::ranks, DomainKind::surface, kind_of(command.solve.executor)));
  if (!command.leads()) command.quiet = true;
  const PropagateOptions wanted = propagate_options(command.solve);
  Precision precision = precision_of(command.solve);
  if (precision == Precision::float64 && command.solve.precision == "float")
    command.solve.precision = "double, which exact distances need";
  Triangulation triangulation = triangulation_of(command.triangulation);
  const std::vector<SetArgument> arguments = parse_source_sets(command.sources);
  if (command.out != "-" && !is_vdb(command.out) && !command.writes_parts())
    check_output_name(command.out, command.input, AnyShape::field_extensions(DomainKind::cloud));
  check_picture(command.picture, command.input);
  check_isolines(command.isolines, command.input);
  std::vector<std::string> read = {metric_file(command.metric), mask_file(command.mask),
                                   command.solve.table};
  for (const SetArgument& argument : arguments) read.push_back(argument.file);
  read.insert(read.end(), command.more.begin(), command.more.end());
  if (command.out != "-") check_output_place(command.out, read, "--out");
  check_output_place(command.isolines.out, read, "--isolines-out");
  check_outputs_differ(
      {command.out, command.isolines.out, command.picture.file, command.picture.html});

  command.fill.volume.writes_volume = is_vdb(command.out);
  ProgressLine progress(command.quiet);
  const Domain domain = load_domain(command, progress);
  if (command.writes_parts()) check_partitioned(domain, command.out);
  if (domain.cloud() == nullptr && command.out != "-" && !command.writes_parts())
    check_output_name(command.out, command.input, AnyShape::field_extensions(domain.kind()));
  check_isolines(command.isolines, domain);
  const std::shared_ptr<const Mask> mask = read_mask(command.mask, domain);
  const std::shared_ptr<const Mask> open = without_collapsed(domain, mask);
  const std::vector<Source> sources =
      locate_source_sets(domain, arguments, !command.metric.text.empty(), open.get());
  require_open(mask.get(), domain, sources);
  const std::vector<PointSource> points = as_points(sources);
  if (have_shapes(domain, sources)) {
    if (triangulation == Triangulation::automatic) triangulation = Triangulation::input;
    if (command.solve.executor.name == "auto") command.solve.executor.name = "serial";
    // Labels start from them in double precision, and go where paths are refracted.
    const bool by_labels =
        wanted.accuracy.kind() == Accuracy::Kind::fast || !command.metric.text.empty();
    if (by_labels && precision == Precision::float32 && !command.solve.precision_given &&
        command.solve.executor.name != "gl") {
      precision = Precision::float64;
      command.solve.precision = "double, which labels of lines need";
    }
  }

  if (!command.metric.text.empty()) progress.phase("reading the metric");
  auto lengths = measure(command.metric, domain, Jumps::refract);
  check_triangulation(triangulation, domain);
  progress.phase("building");
  const AnyDomain solver(domain, {.precision = precision,
                                  .triangulation = triangulation,
                                  .lengths = lengths,
                                  .mask = mask,
                                  .threads = command.solve.executor.threads.value_or(0),
                                  .progress = progress.share_callback()});

  progress.phase("solving");
  PropagateOptions options = wanted;
  options.progress = progress.callback();
  const Stopwatch solving;
  Executor executor = choose_executor(command.solve.executor, options, solver, sources.size());
  if (command.among != nullptr) {
    OpenMP& team = std::get<OpenMP>(executor);
    if (!command.solve.executor.threads) team.threads = command.among->threads;
    team.ranks = &command.among->pieces;
    command.among->all_come();
    // One that writes parts waits for all others to write theirs; what is drawn is solved for.
    const std::array outputs = {command.out, command.isolines.out, command.picture.file,
                                command.picture.html};
    check_same_words(command.among->pieces, outputs, "outputs");
  }
  // What draws arcs asks the field inside of triangles, too.
  std::optional<AnyPathField> paths;
  const bool draws_inside = !command.isolines.out.empty() || !command.picture.file.empty();
  if (draws_inside && !points.empty() && is_known_inside(solver, executor, points, options) &&
      (!command.isolines.out.empty() || shows_inside(solver)))
    paths.emplace(solver.path_field(executor, points, options));
  const AnyField field =
      paths ? paths->field()
            : solver.solve(executor, points.empty() ? SourceList(sources) : SourceList(points),
                           options);
  const double solve = solving.seconds();

  const std::vector<double> distance = field.doubles();
  DistanceOutcome outcome{reach_of(distance, sources), solver.build_seconds(), solve, executor};
  if (command.among != nullptr) {
    outcome.ranks = rank_counts(command.among->pieces, field.statistics().sent_bytes);
    command.among->all_come();
  }

  // What is written and drawn is what is open.
  const bool shown_open =
      open != nullptr &&
      (!command.out.empty() || !command.isolines.out.empty() || command.picture.wanted());
  const Domain shown = shown_open ? domain.open_part(*open) : domain;
  const bool plain = command.out == "-";
  const std::vector<double> isovalues = isoline_values(command.isolines, distance);
  if (command.writes_parts()) {
    progress.phase("writing " + command.out);
    write_partitioned(
        shown, command.out, distance, field.file_label(), field.error(),
        {command.among->pieces.rank(), command.among->pieces.count(), command.among->all_come});
  } else if (!command.out.empty() && command.leads()) {
    progress.phase("writing " + (plain ? "the distances" : command.out));
    const std::vector<std::int32_t> label = field.file_label();
    if (on_standard_output(command.out)) progress.clear();
    if (plain) {
      const std::span<const std::uint32_t> original =
          domain.cloud() != nullptr ? std::span(domain.cloud()->points.original)
                                    : std::span<const std::uint32_t>();
      io::OutputFile out("csv:-");
      io::write_csv(out, {domain.vertices(), {}, {}, distance, label, original, field.error()});
      out.commit();
    } else {
      shown.write_field(command.out, distance, label, field.error());
    }
  }
  if (!command.isolines.out.empty() && command.leads()) {
    progress.phase("writing " + command.isolines.out);
    write_level_sets(command.isolines.out, shown, solver, field, paths ? &*paths : nullptr,
                     isovalues, 1e-3 * *command.isolines.step);  // which no eye sees
  }
  if (command.picture.wanted() && command.leads()) {
    progress.phase("drawing " + command.picture.file);
    SceneContent content;
    content.distance = distance;
    const bool cells = command.picture.colour == "cells";
    const std::vector<std::int32_t> label = cells ? field.nearest() : std::vector<std::int32_t>();
    content.label = label;
    std::optional<FineField> fine;
    if (paths && !cells && shows_inside(solver)) {
      fine = field_for_picture(domain, *paths);
      content.fine = &*fine;
    }
    for (const Source& source : sources) content.mark(domain, source);
    write_picture(command.picture, shown, content, command.quiet);
  }
  progress.clear();
  const auto check_reached = [&] {
    if (outcome.beside_source > 0) return;
    const std::string apart = apart_sentence(domain, outcome.from);
    throw NothingReached(
        command.input + ": nothing reached: " +
        (apart.empty() ? "no vertex but the source itself has a finite distance" : apart));
  };
  if (!command.leads()) return check_reached();

  Summary summary =
      summary_of(command, domain, solver, field, lengths.get(), arguments, sources, outcome);
  report_picture(command.picture, shown, summary);
  Notes notes;
  const AskedPoints asked = asked_points(arguments, sources);
  notes.add(far_notes(domain, asked.asked, asked.found));
  notes.add(
      notes_on(command, solver, field, sources, options, outcome.executor, isovalues.empty()));
  summary.print(command,
                {command.out, command.isolines.out, command.picture.file, command.picture.html},
                notes);
  check_reached();
  notes.say(command.quiet);
}

}  // namespace

void add_distance_command(CLI::App& tool, Action& action, const Among* among) {
  auto command = std::make_shared<DistanceCommand>();
  command->among = among;
  if (among != nullptr) command->solve.executor.name = "openmp";
  CLI::App& app = *tool.add_subcommand(
      "distance", "Geodesic distance of every vertex from one or more sources");
  const OptionGroup add(app);
  add_inputs(app, *command);
  add("--source,-s", command->sources, "WHERE", source_set_help)
      ->required()
      ->allow_extra_args(false);
  add("--out,-o", command->out, "FILE",
      "write the distances: .csv .npy .gii .ply .vtk .vtu .glb .gltf (.pcd of clouds,\n"
      ".vdb of solids) by extension, or - for CSV on standard output, ply:- for a .ply there,\n"
      "and so on (the summary then goes to standard error); among ranks also .pvtu,\n"
      "of which each rank writes a part");
  app.add_flag("--in-parts", command->in_parts,
               "among ranks: none reads or holds the whole, each has its part. A binary .ply of\n"
               "triangles, or a .pvtu; sources vertex:ID and point:X,Y,Z; results as a .pvtu");
  add_isoline_options(app, command->isolines);
  add_solve_options(app, command->solve, true);
  add_triangulation_option(app, command->triangulation);
  add_metric_option(app, command->metric);
  add_mask_option(app, command->mask);
  add_picture_options(app, command->picture, true);
  add_input_options(app, *command);
  add_verbose_option(app, *command);
  app.footer(
      "Examples:\n"
      "  plexway distance knot.ply --source vertex:0 --out distance.ply\n"
      "  plexway distance knot.ply --source point:1,0,0.5 --radius 2 --json\n"
      "  plexway distance knot.ply --source vertex:0 --source vertex:99 --out nearest.csv\n"
      "  plexway distance hills.off --source boundary --source vertex:900+0.5 -o rim.vtu\n"
      "  plexway distance knot.ply --source segment:1,0,0,0,1,0 --source circle:0,0,1,0.2\n"
      "  plexway distance knot.ply --source vertex:0 --isoline-step 0.1 --isolines-out lines.obj\n"
      "  plexway distance organ.off --as solid --max-volume 1e-3 --source point:0,0,0 -o d.vtu\n"
      "  plexway distance fluid.vdb --source point:0,0,0 --out field.vdb\n"
      "  plexway distance broken.stl --repair --as solid --source vertex:0 --out d.glb\n"
      "  plexway distance part.stl --source vertex:0 --triangulation delaunay -o d.vtu\n"
      "  plexway distance ground.off --source vertex:0 --metric speed:speeds.txt -o times.vtu\n"
      "  plexway distance cortex.surf.gii --source vertex:0 --mask vertices:wall.txt -o d.npy\n"
      "  plexway distance vessels.obj --source vertex:0 --out distance.vtk\n"
      "  plexway distance knot.ply --source vertex:0 --picture knot.png --view iso\n"
      "  plexway distance scan.pcd --voxel 0.01 --denoise --source point:0,0,0 --out d.ply\n"
      "  plexway distance knot.ply --source vertex:0 --quiet --out - | sort -t, -gk2 | tail -1");
  app.callback([command, &action] {
    action = [command] {
      command->in_parts ? run_distance_in_parts(*command) : run_distance(*command);
    };
  });
}

}  // namespace plexway::detail::cli
