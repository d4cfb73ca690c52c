#include "tool/commands/pairs_matrix.hpp"

#include <array>
#include <cmath>
#include <filesystem>
#include <numeric>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>

#include <plexway/any_domain.hpp>
#include <plexway/error.hpp>
#include <plexway/io/sparse_file.hpp>

#include "shape/arguments/arguments.hpp"
#include "shape/info/report.hpp"
#include "shape/kept_build.hpp"
#include "shape/modules/module.hpp"
#include "shape/pairs/pair_files.hpp"
#include "shape/pairs/pair_tables.hpp"
#include "tool/app.hpp"
#include "tool/report/console.hpp"
#include "tool/report/distance_report.hpp"

namespace plexway::cli {

namespace {

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
                       "stopped can go on: name one, such as pairs.csv");
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
  Notes notes;
  notes.add(report.warnings);
  Json json;
  Table table;
  json["input"] = command.input;
  json["kind"] = domain.kind_name();
  json["rows"] = files.rows.size();
  json["columns"] = files.columns.size();
  table.add("input", command.input);
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
    json["seconds"]["load"] = domain.load_seconds();
    if (domain.mesh_seconds()) json["seconds"]["mesh"] = *domain.mesh_seconds();
    json["seconds"]["solve"] = report.seconds;
    table.add("work", counted(report.solved.rows, "rows") + " solved" +
                          (counts && command.verbose
                               ? ", " + counted(report.solved.statistics.expansions, "expansions")
                               : ""));
    table.add("time", short_time(report.seconds));
    if (files.sparse()) {
      json["entries"] = report.entries;
      table.add("entries", std::to_string(report.entries));
    }
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
    add_written(table, {command.out, command.stats, command.histogram});
  }
  notes.tell(json);
  if (command.json)
    write_output(json_text(json));
  else if (!command.quiet)
    write_output(table.text());
  flush_output();
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

}  // namespace

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

}  // namespace plexway::cli
