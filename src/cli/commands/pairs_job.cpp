#include "cli/commands/pairs_job.hpp"

#include <CLI/CLI.hpp>
#include <array>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <span>
#include <string_view>
#include <type_traits>
#include <utility>

#include <plexway/any/pairs.hpp>
#include <plexway/error.hpp>
#include <plexway/io/sparse_file.hpp>
#include <plexway/version.hpp>

#include "any/hdf5_functions.hpp"
#include "cli/report/distance_output.hpp"
#include "io/extension.hpp"

namespace plexway::cli {
namespace {

namespace fs = std::filesystem;
using io::Fingerprint;
using io::MatrixFile;
using io::MatrixNumber;

template <class Numbers>
std::string fingerprint_of(const Numbers& numbers) {
  Fingerprint print;
  print.add_numbers(numbers);
  return print.text();
}

}  // namespace

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
  for (const std::string* out : {&command.out, &command.stats, &command.histogram})
    if (on_standard_output(*out))
      throw UsageError(*out + ": what can be gone on with is a file, not standard output");
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

void describe(Job& job, const MeasuredLengths* lengths) {
  const MatrixCommand& command = job.command;
  auto& lines = job.description;
  const auto add = [&](const char* name, std::string value) {
    lines.push_back({name, std::move(value)});
  };
  const auto number = [](double value) {
    std::array<char, 32> text{};
    std::snprintf(text.data(), text.size(), "%.17g", value);
    return std::string(text.data());
  };
  add("plexway", version_string);
  add("input", fingerprint_of(job.domain) + " " + std::string(job.domain.kind_name()));
  add("rows", std::to_string(job.rows.size()) + " " + fingerprint_of(SourceList(job.rows)));
  add("columns", std::to_string(job.columns.size()) + " " + fingerprint_of(job.columns));
  add("precision", command.solve.precision);
  if (command.solve.executor.name == "gl") add("executor", "gl");  // the others have one's bits
  add("accuracy", name_of(job.options.accuracy));
  add("visibility", command.solve.visibility);
  if (!command.solve.table.empty()) add("table", fingerprint_of(job.options.probe.share));
  add("schedule", command.solve.schedule + " " + number(job.options.step));
  add("triangulation", command.triangulation.name);
  if (lengths != nullptr) add("metric", fingerprint_of(*lengths));
  if (job.mask) {
    add("mask", plexway::fingerprint_of(*job.mask));
  }
  if (command.radius) add("radius", number(*command.radius));
  if (command.nearest) add("nearest", std::to_string(*command.nearest));
  if (job.parcels) add("labels", fingerprint_of(job.parcels->parcels.of));
  if (!job.parcels && !command.out.empty()) add("type", command.type);
  if (command.symmetric) add("symmetric", "yes");
  if (!command.histogram.empty())
    add("histogram", number(*command.bin_width) + " " + std::to_string(command.bins));
  std::string written;
  for (const std::string* name : {&command.out, &command.stats, &command.histogram})
    if (!name->empty())
      written += (written.empty() ? "" : " ") + fs::path(*name).filename().string();
  add("written", written);
}

bool is_hdf5(const std::string& file) { return io::lower_extension(file) == ".h5"; }

double expected_bytes(const Job& job) {
  double bytes = 0;
  if (job.wants_matrix() && !job.sparse)
    bytes += MatrixFile::bytes(job.rows.size(), job.columns.size(), job.number) *
             (is_hdf5(job.command.out) ? 2 : 1);
  if (job.parcels)
    bytes += MatrixFile::bytes(job.rows.size(), job.parcels->parcels.count, MatrixNumber::float64);
  if (job.wants_statistics())
    bytes += MatrixFile::bytes(job.rows.size(), job.statistics_columns(), MatrixNumber::float64);
  return bytes;
}

void add_matrix_options(CLI::App& app, MatrixCommand& command) {
  const std::string group = "Matrices of any size";
  app.add_option("--sources", command.sources,
                 "a row each: all, or FILE with a vertex (0-based) a line or the .csv of\n"
                 "'plexway farthest'")
      ->type_name("FILE|all")
      ->group(group);
  app.add_option("--targets", command.targets, "a column each, vertices: all (default) or FILE")
      ->type_name("FILE|all")
      ->group(group);
  app.add_option("--type", command.type, "numbers of the matrix: float16, float32 or float64")
      ->type_name("NAME")
      ->group(group);
  app.add_option("--radius", command.radius,
                 "only what is no farther: a sparse matrix, .npz (scipy, CSR) or .mtx")
      ->type_name("R")
      ->group(group);
  app.add_option("--nearest", command.nearest, "only the K nearest of each row; sparse likewise")
      ->check(CLI::NonNegativeNumber)
      ->type_name("K")
      ->group(group);
  app.add_flag("--symmetric", command.symmetric,
               "of the two ways between two vertices the shorter counts for both")
      ->group(group);
  app.add_option("--labels", command.labels,
                 "a label a vertex, a line each (below 0: none) or .label.gii: --out is then\n"
                 "the mean distance between parcels, .npy or .csv")
      ->type_name("FILE")
      ->group(group);
  app.add_option("--stats", command.stats,
                 "of each row: how many are reached, mean, largest, farthest vertex; .csv")
      ->type_name("FILE")
      ->group(group);
  app.add_option("--histogram", command.histogram, "how many distances of which size; .csv")
      ->type_name("FILE")
      ->group(group);
  app.add_option("--bin-width", command.bin_width, "of the histogram")
      ->type_name("X")
      ->group(group);
  app.add_option("--bins", command.bins, "of the histogram (default 100); the last has the rest")
      ->check(CLI::NonNegativeNumber)
      ->type_name("N")
      ->group(group);
  app.add_flag("--estimate", command.estimate, "only say how long it will take, and how many bytes")
      ->group(group);
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

}  // namespace plexway::cli
