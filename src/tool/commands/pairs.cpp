#include <array>
#include <cmath>
#include <filesystem>
#include <memory>
#include <numeric>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <plexway/any_domain.hpp>
#include <plexway/error.hpp>
#include <plexway/io/sparse_file.hpp>
#include <plexway/pairs/distance_matrix.hpp>

#include "shape/arguments/arguments.hpp"
#include "shape/files/files.hpp"
#include "shape/files/kept_build.hpp"
#include "shape/info/report.hpp"
#include "shape/info/solve_words.hpp"
#include "shape/modules/module.hpp"
#include "shape/pairs/pair_files.hpp"
#include "shape/warnings/field_warnings.hpp"
#include "tool/app.hpp"
#include "tool/commands/sampling_command.hpp"
#include "tool/options/input.hpp"
#include "tool/options/solve_options.hpp"
#include "tool/report/console.hpp"
#include "tool/report/summary.hpp"

namespace plexway::detail::cli {
namespace {

/// What `plexway pairs --sources` takes, as typed.
struct MatrixCommand : InputCommand {
  std::string sources, targets;  ///< FILE or "all"
  std::string out, stats, histogram, labels;
  std::string type = "float32";
  std::optional<double> radius;
  std::optional<std::size_t> nearest;
  std::optional<double> bin_width;
  std::size_t bins = 100;
  bool symmetric = false, estimate = false;
  SolveOptions solve;
  MaskArgument mask;
  MetricArgument metric;
  TriangulationArgument triangulation;
  const Among* among = nullptr;  ///< who shares the rows; null: nobody
};

/// What the rows of a matrix come to together.
void add_statistics(const StatisticsSummary& summary, Json& json, Table& table) {
  json["diameter"] = summary.diameter;
  json["farthest_pair"] = {summary.from, summary.to};
  json["radius"] = json_number(summary.radius);
  json["mean"] = summary.mean;
  json["pairs"] = summary.pairs;
  table.add("diameter", short_number(summary.diameter) + ", from row " +
                            std::to_string(summary.from) + " to vertex " +
                            std::to_string(summary.to));
  table.add("mean", short_number(summary.mean) + " over " + std::to_string(summary.pairs) +
                        " pairs; the least of the rows' largest is " +
                        short_number(summary.radius));
}

// Options and names of files that go together, before anything is read.
void check_names(const MatrixCommand& command) {
  const bool sparse = command.radius || command.nearest;
  constexpr std::array<std::string_view, 2> dense_files = {".npy", ".h5"};
  constexpr std::array<std::string_view, 2> parcel_files = {".npy", ".csv"};
  constexpr std::array<std::string_view, 1> tables = {".csv"};
  if (command.out.empty() && command.stats.empty() && command.histogram.empty())
    throw UsageError("--sources: say what to write: --out, --stats or --histogram");
  if (sparse && (!command.labels.empty() || !command.stats.empty() || !command.histogram.empty() ||
                 command.symmetric))
    throw UsageError(
        "--radius and --nearest make a sparse matrix: leave out --labels, --stats, --histogram and "
        "--symmetric");
  if (command.radius && !(*command.radius >= 0 && std::isfinite(*command.radius)))
    throw UsageError("--radius must be a number >= 0");
  if (command.nearest && *command.nearest == 0) throw UsageError("--nearest must be >= 1");
  if (!command.labels.empty() && command.out.empty())
    throw UsageError("--labels: give --out for the matrix of means between parcels");
  if (!command.labels.empty() && command.symmetric)
    throw UsageError("--symmetric is for distances between vertices: leave out --labels");
  if (!command.histogram.empty() && !(command.bin_width && *command.bin_width > 0))
    throw UsageError("--histogram needs --bin-width, a number > 0");
  if (command.histogram.empty() && command.bin_width)
    throw UsageError("--bin-width goes with --histogram");
  if (command.bins == 0 || command.bins > 1'000'000)
    throw UsageError("--bins must be from 1 to 1000000");
  for (const auto& [out, option] :
       {std::pair(&command.out, "--out"), std::pair(&command.stats, "--stats"),
        std::pair(&command.histogram, "--histogram")})
    if (on_standard_output(*out))
      throw UsageError(std::string(option) +
                       " -: pairs go to a file, not standard output, so that a run that was "
                       "stopped can go on: name one");
  check_output_name(command.out, command.input,
                    sparse                   ? io::SparseFile::extensions()
                    : command.labels.empty() ? std::span<const std::string_view>(dense_files)
                                             : parcel_files);
  check_output_name(command.stats, command.input, tables, "--stats");
  check_output_name(command.histogram, command.input, tables, "--histogram");
  check_outputs_differ({command.out, command.stats, command.histogram});
  if (is_hdf5(command.out)) hdf5_functions("--out " + command.out);
  const std::array read = {command.sources,
                           command.targets,
                           command.labels,
                           mask_file(command.mask),
                           metric_file(command.metric),
                           command.solve.table};
  for (const auto& [name, option] :
       {std::pair(&command.out, "--out"), std::pair(&command.stats, "--stats"),
        std::pair(&command.histogram, "--histogram")})
    check_output_place(*name, read, option);
}

// What solves rows, a thread each unless it is a device.
Executor executor_of(const MatrixCommand& command) {
  const ExecutorArgument& argument = command.solve.executor;
  if (argument.name == "gl") {
    if (command.radius || command.nearest)
      require("--executor gl", support(Purpose::rows, DomainKind::surface, ExecutorKind::gl));
    return GL{.device = argument.device.value_or(-1)};
  }
  if (argument.name == "serial" || !openmp_built()) return Serial{};
  const int usual = command.among == nullptr ? 0 : command.among->threads;
  return OpenMP{.threads = argument.threads.value_or(usual)};
}

// What options say of them.
PairFiles asked_for(const MatrixCommand& command) {
  PairFiles files;
  files.solve = propagate_options(command.solve);
  files.building.precision = precision_of(command.solve);
  files.building.triangulation = triangulation_of(command.triangulation);
  files.building.threads = command.solve.executor.threads.value_or(
      command.among != nullptr ? command.among->threads : 0);
  files.radius = command.radius;
  files.nearest = command.nearest;
  files.symmetric = command.symmetric;
  files.number = io::matrix_number_of(command.type);
  files.matrix = command.out;
  files.statistics = command.stats;
  files.histogram = command.histogram;
  files.reader = Reader::tool;
  files.bin_width = command.bin_width.value_or(files.bin_width);
  files.bins = command.bins;
  return files;
}

// What they are of.
void take_rows(const MatrixCommand& command, const Domain& domain, ProgressLine& progress,
               PairFiles& files) {
  if (command.targets.empty() || command.targets == "all") {
    files.columns.resize(domain.vertices());
    std::iota(files.columns.begin(), files.columns.end(), Index{0});
  } else {
    files.columns = read_vertex_list(command.targets, domain, "--targets");
  }
  if (command.sources == "all") {
    for (Index v = 0; v < domain.vertices(); ++v) files.rows.push_back(PointSource::at(v));
  } else {
    files.rows = read_point_list(command.sources, domain);
  }
  files.building.mask = read_mask(command.mask, domain);
  if (command.sources != "all") require_open(files.building.mask.get(), domain, files.rows);
  if (!command.labels.empty()) {
    files.parcels = read_parcels(command.labels, domain.vertices());
    files.parcels->take(files.rows, files.columns, command.labels);
  }
  if (files.symmetric && !files.square())
    throw UsageError("--symmetric: --sources and --targets must be the same vertices");
  if (!command.metric.text.empty()) progress.phase("reading the metric");
  files.building.lengths = measure(command.metric, domain, Jumps::refract);
}

void print(const MatrixCommand& command, const Domain& domain, const PairFiles& files,
           const PairFilesReport& report) {
  Summary summary(command.input, domain.kind_name());
  Json& json = summary.json;
  Table& table = summary.table;
  json["rows"] = files.rows.size();
  json["columns"] = files.columns.size();
  table.add("matrix",
            std::to_string(files.rows.size()) + " x " + std::to_string(files.columns.size()));
  if (command.estimate) {
    json["estimate"] = {{"seconds", report.expected_seconds}, {"bytes", report.expected_bytes}};
    table.add("estimate",
              short_time(report.expected_seconds) + " on " + report.team() +
                  (files.sparse() ? "" : ", " + io::short_bytes(report.expected_bytes)));
  } else {
    json["rows_solved"] = report.solved.rows;
    json["blocks_kept"] = report.resumed_blocks;
    json["threads"] = report.threads;
    if (command.among != nullptr) json["ranks"] = report.ranks;
    // Devices count them for all rows of a launch together.
    const bool counts = command.solve.executor.name != "gl";
    if (counts) json["expansions"] = report.solved.statistics.expansions;
    if (report.solved.statistics.windows_gave_up > 0)
      json["windows_gave_up"] = report.solved.statistics.windows_gave_up;
    summary.took_loading(domain);
    summary.took("solve", report.seconds);
    table.add("work", counted(report.solved.rows, "rows") + " solved" +
                          (counts && command.verbose
                               ? ", " + counted(report.solved.statistics.expansions, "expansions")
                               : ""));
    if (files.sparse()) summary.add("entries", report.entries, std::to_string(report.entries));
    if (report.asymmetry) {
      const io::Asymmetry& ways = *report.asymmetry;
      json["asymmetry"] = {{"largest", ways.largest},
                           {"mean", ways.mean},
                           {"one_way", static_cast<double>(ways.one_way)}};
      table.add("there and back", "differ by " + short_number(ways.mean) +
                                      " of the shorter on average, " + short_number(ways.largest) +
                                      " at most" +
                                      (command.symmetric ? "; the shorter counts for both" : ""));
    }
    if (report.statistics) add_statistics(*report.statistics, json, table);
  }
  Notes notes;
  notes.add(report.warnings);
  std::vector<std::string> written;
  if (!command.estimate) written = {command.out, command.stats, command.histogram};
  summary.print(command, written, notes);
  notes.say(command.quiet);
}

// INPUT: where ranks share a node, one of them reads and builds it, and all map what it made. Not
// so what is measured by a metric or masked, and kinds that cannot be kept: each rank has its own.
Domain load(const MatrixCommand& command, const BuildOptions& building, ProgressLine& progress) {
  const auto read = [&] { return load_domain(command, progress); };
  if (command.among == nullptr || !command.among->once_a_node || is_kept_build(command.input) ||
      !command.metric.text.empty() || !command.mask.text.empty())
    return read();
  std::optional<Domain> domain;
  command.among->once_a_node(
      [&](const std::filesystem::path& file) {
        domain = read();
        try {
          AnyDomain(*domain, building).keep(file);
        } catch (const InputError&) {
          throw;
        } catch (const Error&) {  // no room for it, or not kept
          return;
        }
        domain.reset();
      },
      [&](const std::filesystem::path& file) {
        if (!domain)
          domain = std::filesystem::exists(file) ? read_kept_for(file, command.input) : read();
      });
  return *domain;
}

void add_matrix_options(CLI::App& app, MatrixCommand& command) {
  const OptionGroup add(app, "Matrices of any size");
  add("--sources", command.sources, "FILE|all",
      "a row each: all, or FILE with a vertex (0-based) a line or the .csv of\n"
      "'plexway farthest'");
  add("--targets", command.targets, "FILE|all", "a column each, vertices: all (default) or FILE");
  add("--type", command.type, "NAME", "numbers of the matrix: float16, float32 or float64");
  add("--radius", command.radius, "R",
      "only what is no farther: a sparse matrix, .npz (scipy, CSR) or .mtx");
  add("--nearest", command.nearest, "K", "only the K nearest of each row; sparse likewise")
      ->check(CLI::NonNegativeNumber);
  add.flag("--symmetric", command.symmetric,
           "of there and back the shorter distance counts for both");
  add("--labels", command.labels, "FILE",
      "a label a vertex, a line each (below 0: none) or .label.gii: --out is then\n"
      "the mean distance between parcels, .npy or .csv");
  add("--stats", command.stats, "FILE",
      "of each row: how many are reached, mean, largest, farthest vertex; .csv");
  add("--histogram", command.histogram, "FILE", "how many distances of which size; .csv");
  add("--bin-width", command.bin_width, "X", "of the histogram");
  add("--bins", command.bins, "N", "of the histogram (default 100); the last has the rest")
      ->check(CLI::NonNegativeNumber);
  add.flag("--estimate", command.estimate, "only say how long it will take, and how many bytes");
}

std::string only_for_matrices(const MatrixCommand& command) {
  if (!command.targets.empty()) return "--targets";
  if (command.radius) return "--radius";
  if (command.nearest) return "--nearest";
  if (command.symmetric) return "--symmetric";
  if (command.estimate) return "--estimate";
  if (!command.labels.empty()) return "--labels";
  if (!command.stats.empty()) return "--stats";
  if (!command.histogram.empty()) return "--histogram";
  if (!command.metric.text.empty()) return "--metric";
  if (!command.mask.text.empty()) return "--mask";
  if (command.solve.executor.threads) return "--threads";
  if (command.solve.visibility != "saddles") return "--visibility";
  if (command.solve.schedule_given) return "--schedule";
  if (command.solve.step_given) return "--step";
  return {};
}

void run_matrix(const MatrixCommand& command) {
  PairFiles files = asked_for(command);
  const Executor executor = executor_of(command);
  check_names(command);
  ProgressLine progress(command.quiet);
  const Domain domain = load(command, files.building, progress);
  check_triangulation(files.building.triangulation, domain);
  take_rows(command, domain, progress, files);
  const PairFilesProgress tell = {
      .stage = [&](std::string_view what) { progress.phase(what); },
      .rows =
          [&](const PairsProgress& at) {
            progress.done(static_cast<double>(at.rows_done) / static_cast<double>(at.rows),
                          short_number(at.rows_per_second) + " rows a second, " +
                              short_time(at.seconds_left) + " left");
          },
      .note = [&](std::string_view text) { progress.note(text); }};
  RowRanks* const ranks = command.among == nullptr ? nullptr : &command.among->ranks;
  const PairFilesReport report = command.estimate
                                     ? estimate_pair_files(executor, domain, files, tell, ranks)
                                     : write_pair_files(executor, domain, files, tell, ranks);
  progress.clear();
  if (ranks != nullptr && !ranks->leads()) return;
  print(command, domain, files, report);
}

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
  const Precision precision = precision_of(pairs.solve);
  const Accuracy accuracy = accuracy_of(pairs.solve.accuracy);
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

}  // namespace plexway::detail::cli
