#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include <plexway/error.hpp>
#include <plexway/pairs/distance_matrix.hpp>

#include "shape/arguments/arguments.hpp"
#include "shape/info/solve_words.hpp"
#include "shape/point_file.hpp"
#include "shape/warnings/field_warnings.hpp"
#include "tool/app.hpp"
#include "tool/commands/commands.hpp"
#include "tool/commands/pairs_matrix.hpp"
#include "tool/commands/sampling_command.hpp"
#include "tool/report/console.hpp"
#include "tool/report/summary.hpp"

namespace plexway::cli {
namespace {

struct PairsCommand : MatrixCommand {
  std::vector<std::string> points;
};

void run_pairs(const PairsCommand& pairs) {
  if (pairs.points.empty() == pairs.sources.empty())
    throw UsageError("give --sources FILE|all, or points one by one with --source");
  if (!pairs.sources.empty()) {
    run_matrix(pairs);
    return;
  }
  if (pairs.among != nullptr)
    throw UsageError("ranks share the rows of --sources FILE|all, not those of --source");
  if (const std::string other = only_for_matrices(pairs); !other.empty())
    throw UsageError(other + " goes with --sources FILE|all, not with --source");
  SamplingCommand command;
  static_cast<InputCommand&>(command) = pairs;
  command.out = pairs.out;
  command.precision = pairs.solve.precision;
  command.precision_given = pairs.solve.precision_given;
  command.accuracy = pairs.solve.accuracy;
  const Precision precision = precision_of(command);
  const Accuracy accuracy = accuracy_of(command.accuracy);
  check_output_name(command.out, command.input, matrix_file_extensions());
  for (const std::string& text : pairs.points)
    if (text == "all" || (text.find(':') == text.npos && std::filesystem::exists(text)))
      throw UsageError("--source " + text + ": did you mean '--sources " + text + "'?");
  const auto arguments = parse_sources(pairs.points);
  ProgressLine progress(command.quiet);
  Phases phases;
  const Domain domain = load_domain(command, progress);
  phases.end("load");
  const auto points = locate_sources(domain, arguments);
  progress.phase("solving");
  DistanceMatrix matrix;
  Notes notes = with_sampled(domain, precision, [&](const auto& complex, const auto& numbers) {
    phases.end("build");
    matrix = distance_matrix(Serial{}, complex, numbers.inside(points), progress.share_callback(),
                             accuracy);
    phases.end("solve");
  });
  if (!command.out.empty()) write_matrix(command.out, matrix.size, matrix.distance);
  phases.end("write");
  progress.clear();

  Summary summary = points_summary(command, domain, "points", points.size());
  add_accuracy(domain.kind(), matrix.accuracy, matrix.statistics, summary.json);
  summary.json["asymmetry"] = matrix.asymmetry;
  summary.table.add("there and back",
                    "differ by " + short_number(matrix.asymmetry) + " of the shorter at most");
  notes.add(far_notes(domain, arguments, points));
  notes.add(work_warnings({.statistics = matrix.statistics,
                           .accuracy = matrix.accuracy,
                           .has_windows = has_accuracies(domain.kind()),
                           .vertices = domain.vertices(),
                           .fields = points.size()},
                          Reader::tool));
  if (matrix.asymmetry > 0.01)
    notes.add("distances between some points, there and back, differ by " +
              short_number(100 * matrix.asymmetry) +
              " %, so one of them is off by half of that or more: 'plexway path' is more exact");
  finish(summary, command, matrix.statistics, phases, notes);
}

}  // namespace

void add_pairs_command(CLI::App& tool, Action& action, const Among* among) {
  auto command = std::make_shared<PairsCommand>();
  command->among = among;
  command->solve.executor.name = "auto";
  CLI::App& app = *tool.add_subcommand(
      "pairs", "Matrices of distances: between chosen points, or of any size, restartable");
  const OptionGroup add(app);
  add_input(app, *command);
  add("--source,-s", command->points, "WHERE",
      "a point of a small symmetric matrix: vertex:ID or point:X,Y,Z; repeat it")
      ->allow_extra_args(false);
  add_output(
      app, "--out,-o", command->out,
      "write the matrix: .csv or .npy of points (- for CSV on standard output); .npy or .h5\n"
      "(HDF5, compressed) of --sources, .npz or .mtx where it is sparse",
      "csv");
  add_mask_option(app, command->mask);
  add_matrix_options(app, *command);
  add_solve_options(app, command->solve, false);
  add_triangulation_option(app, command->triangulation);
  add_metric_option(app, command->metric);
  add_input_options(app, *command);
  add_verbose_option(app, *command);
  app.footer(
      "Run again after it was ended, the same command goes on where it was.\n\n"
      "Examples:\n"
      "  plexway pairs knot.ply -s vertex:0 -s vertex:50 -s point:1,0,0.5 --out matrix.csv\n"
      "  plexway pairs knot.ply --sources all --out matrix.npy --symmetric\n"
      "  plexway pairs knot.ply --sources all --radius 0.3 --out near.npz\n"
      "  plexway farthest knot.ply --count 100 --out landmarks.csv\n"
      "  plexway pairs knot.ply --sources landmarks.csv --out landmarks.npy");
  app.callback([command, &action] {
    // One process talks.
    if (command->among != nullptr && !command->among->ranks.leads()) command->quiet = true;
    action = [command] { run_pairs(*command); };
  });
}

}  // namespace plexway::cli
