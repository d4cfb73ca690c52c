#include "pairs_matrix.hpp"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <functional>
#include <limits>
#include <memory>
#include <numeric>
#include <optional>
#include <span>
#include <type_traits>
#include <variant>
#include <vector>

#include <plexway/apps/all_pairs.hpp>
#include <plexway/apps/row_reductions.hpp>
#include <plexway/error.hpp>
#include <plexway/io/write_pairs.hpp>
#include <plexway/version.hpp>

#include "console.hpp"
#include "distance_output.hpp"
#include "domain.hpp"
#include "io/extension.hpp"
#include "make_complex.hpp"
#include "pairs_output.hpp"
#include "progress.hpp"
#include "report.hpp"
#include "vertex_list.hpp"

namespace plexway::cli {
namespace {

namespace fs = std::filesystem;
using io::BlockJournal;
using io::Fingerprint;
using io::MatrixFile;
using io::MatrixNumber;

constexpr double infinity = std::numeric_limits<double>::infinity();

/// What is to be made, checked against each other and against the domain.
struct Job {
  const MatrixCommand& command;
  const Domain& domain;
  std::vector<PointSource> rows = {};
  std::vector<Index> columns = {};
  bool square = false;  ///< rows and columns are the same vertices, in the same order
  bool sparse = false;
  MatrixNumber number = MatrixNumber::float32;
  PropagateOptions options;
  std::optional<Mask> mask = {};
  std::optional<ParcelLabels> parcels = {};
  BlockJournal::Description description = {};
  std::size_t block = 32;

  [[nodiscard]] std::size_t blocks() const { return (rows.size() + block - 1) / block; }
  /// Beside which file the journal is.
  [[nodiscard]] const std::string& main_file() const {
    return !command.out.empty()     ? command.out
           : !command.stats.empty() ? command.stats
                                    : command.histogram;
  }
  [[nodiscard]] bool wants_matrix() const { return !command.out.empty() && !parcels; }
  [[nodiscard]] bool wants_statistics() const {
    return !command.stats.empty() || !command.histogram.empty();
  }
  /// Numbers of a row that the statistics keep.
  [[nodiscard]] std::size_t statistics_columns() const {
    return 4 + (command.histogram.empty() ? 0 : command.bins);
  }
};

/// What there is to tell.
struct Outcome {
  PairsReport report;
  double solving = 0;  ///< seconds
  double expected_seconds = 0, expected_bytes = 0;
  std::size_t resumed_blocks = 0;
  std::string asymmetry;
  std::uint64_t entries = 0;
  std::optional<StatisticsSummary> statistics;
  std::size_t threads = 1;
  bool only_estimated = false;
};

void check_names(const MatrixCommand& command) {
  const bool sparse = command.radius || command.nearest;
  constexpr std::array<std::string_view, 1> dense_files = {".npy"};
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
  check_output_name(command.out, command.input,
                    sparse                   ? io::SparseFile::extensions()
                    : command.labels.empty() ? std::span<const std::string_view>(dense_files)
                                             : parcel_files);
  check_output_name(command.stats, command.input, tables, "--stats");
  check_output_name(command.histogram, command.input, tables, "--histogram");
  check_outputs_differ({command.out, command.stats, command.histogram});
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

template <class Numbers>
std::string fingerprint_of(const Numbers& numbers) {
  Fingerprint print;
  print.add_numbers(numbers);
  return print.text();
}

std::string fingerprint_of(const Domain& domain) {
  Fingerprint print;
  print.add_numbers(domain.positions());
  std::visit(
      [&](const auto& shape) {
        using Shape = std::decay_t<decltype(shape)>;
        if constexpr (std::is_same_v<Shape, io::Triangles>) {
          print.add_numbers(shape.triangles);
        } else if constexpr (std::is_same_v<Shape, io::Tets>) {
          print.add_numbers(shape.tets);
        } else if constexpr (std::is_same_v<Shape, io::Edges>) {
          print.add_numbers(shape.edges);
          print.add_numbers(shape.lengths);
        } else {
          print.add_numbers(shape.measured());
          print.add_numbers(shape.neighbours.begin);
          print.add_numbers(shape.neighbours.of);
        }
      },
      domain.shape());
  return print.text();
}

// All that the result depends on, a line each, so that what changed can be named.
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
  add("input", fingerprint_of(job.domain) + " " + std::string(job.domain.kind()));
  Fingerprint rows;
  for (const PointSource& point : job.rows) {
    rows.add_numbers(std::array{point.vertex, point.simplex});
    rows.add_numbers(point.barycentric);
  }
  add("rows", std::to_string(job.rows.size()) + " " + rows.text());
  add("columns", std::to_string(job.columns.size()) + " " + fingerprint_of(job.columns));
  add("precision", command.solve.precision);
  add("visibility", command.solve.visibility);
  if (!command.solve.table.empty()) add("table", fingerprint_of(job.options.probe.share));
  add("schedule", command.solve.schedule + " " + number(job.options.step));
  add("triangulation", command.triangulation.name);
  if (lengths != nullptr) {
    Fingerprint metric;
    metric.add_numbers(lengths->triangles);
    metric.add_numbers(lengths->tets);
    metric.add_numbers(lengths->edges);
    add("metric", metric.text());
  }
  if (job.mask) {
    Fingerprint mask;
    mask.add_numbers(job.mask->closed_vertices());
    mask.add_numbers(job.mask->closed_simplices());
    add("mask", mask.text());
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

double expected_bytes(const Job& job) {
  double bytes = 0;
  if (job.wants_matrix() && !job.sparse)
    bytes += MatrixFile::bytes(job.rows.size(), job.columns.size(), job.number);
  if (job.parcels)
    bytes += MatrixFile::bytes(job.rows.size(), job.parcels->parcels.count, MatrixNumber::float64);
  if (job.wants_statistics())
    bytes += MatrixFile::bytes(job.rows.size(), job.statistics_columns(), MatrixNumber::float64);
  return bytes;
}

std::string asymmetry_text(const io::Asymmetry& found) {
  return short_number(found.largest) + " " + short_number(found.mean) + " " +
         std::to_string(found.pairs) + " " + std::to_string(found.one_way);
}

/// Solves on a complex, by an executor, whatever is missing, and finishes the files.
template <class E, class Complex>
class MatrixRun {
 public:
  using Real = RealOf<Complex>;

  MatrixRun(const Job& job, const E& executor, const Complex& complex,
            const std::vector<PointSource>& rows, ProgressLine& progress)
      : job_(job), executor_(executor), complex_(complex), progress_(progress) {
    request_.rows = SourceList(rows);
    request_.columns = job.columns;
    request_.solve = job.options;
    request_.block = job.block;
  }

  Outcome run() {
    outcome_.expected_bytes = expected_bytes(job_);
    if constexpr (std::is_same_v<E, OpenMP>) outcome_.threads = team_size(executor_);
    estimate();
    if (job_.command.estimate) {
      outcome_.only_estimated = true;
      return outcome_;
    }
    io::check_room(job_.main_file(), outcome_.expected_bytes);
    BlockJournal journal(job_.main_file(), job_.description, job_.blocks());
    outcome_.resumed_blocks = journal.finished();
    if (journal.resumed())
      progress_.note("going on with " + job_.main_file() + ": " +
                     counted(journal.finished(), "blocks") + " of " +
                     std::to_string(journal.blocks()) + " are there");
    request_.progress = [this](const PairsProgress& p) {
      progress_.done(static_cast<double>(p.rows_done) / static_cast<double>(p.rows),
                     short_number(p.rows_per_second) + " rows a second, " +
                         short_time(p.seconds_left) + " left");
      return true;
    };
    progress_.phase("solving");
    if (job_.sparse)
      run_sparse(journal);
    else
      run_dense(journal);
    journal.remove();
    return outcome_;
  }

 private:
  // How long it will take, by some rows: what more of them take than less, as the first of each
  // thread make room for what the others find.
  void estimate() {
    const std::size_t rows = job_.rows.size();
    std::size_t probes = 2 * outcome_.threads;
    if (!job_.command.estimate && rows < 50 * probes) return;
    progress_.phase("estimating");
    double before = solve_some(std::min(probes, rows)), seconds = before;
    for (;;) {
      const std::size_t more = std::min(4 * probes, rows);
      seconds = solve_some(more);
      const double each = (seconds - before) / static_cast<double>(std::max(more - probes, 1UL));
      outcome_.expected_seconds =
          (more > probes && each > 0 ? each : seconds / static_cast<double>(more)) *
          static_cast<double>(rows);
      if (seconds > 0.05 || 16 * more > rows) break;
      probes = more;
      before = seconds;
    }
    if (job_.command.estimate || outcome_.expected_seconds < 5) return;
    std::string text = std::to_string(rows) + " x " + std::to_string(job_.columns.size()) +
                       ": about " + short_time(outcome_.expected_seconds) + " on " +
                       counted(outcome_.threads, "threads");
    if (outcome_.expected_bytes > 0) text += ", " + io::short_bytes(outcome_.expected_bytes);
    progress_.note(text + "; what is finished stays if it is ended before");
  }

  // Seconds for so many rows, spread evenly.
  double solve_some(std::size_t count) {
    std::vector<PointSource> some;
    const auto sources = request_.rows->points();
    for (std::size_t i = 0; i < count; ++i) some.push_back(sources[i * (sources.size() / count)]);
    PairsRequest few = request_;
    few.rows = SourceList(some);
    few.block = 1;
    const Stopwatch watch;
    if (job_.sparse)
      near_pairs(executor_, complex_, few, limits(), {[](std::size_t, SparseRow<Real>) {}});
    else
      all_pairs(executor_, complex_, few, {[](std::size_t, DenseRow<Real>) {}});
    return watch.seconds();
  }

  [[nodiscard]] NearLimits limits() const {
    return {.radius = job_.command.radius.value_or(infinity),
            .nearest = job_.command.nearest.value_or(none)};
  }

  void run_sparse(BlockJournal& journal) {
    io::SparseFile file(job_.command.out, job_.rows.size(), job_.columns.size(), job_.block,
                        job_.number, journal);
    const Stopwatch watch;
    outcome_.report = io::write_near_pairs(executor_, complex_, request_, limits(), file, journal);
    outcome_.solving = watch.seconds();
    progress_.phase("writing " + job_.command.out);
    outcome_.entries = file.commit(journal);
    file.remove();
  }

  void run_dense(BlockJournal& journal) {
    const MatrixCommand& command = job_.command;
    const std::size_t rows = job_.rows.size();
    if (journal.is_complete() && job_.wants_matrix() &&
        !fs::exists(io::PartFile::path_of(command.out))) {
      finish_statistics(nullptr);  // ended between renaming and telling
      return;
    }
    std::optional<MatrixFile> matrix, parcels, statistics;
    std::vector<io::RowOutput<Real>> outputs;
    if (job_.wants_matrix()) {
      matrix.emplace(command.out, rows, job_.columns.size(), job_.number, journal.resumed());
      outputs.push_back({*matrix});
    }
    if (job_.parcels) {
      const Parcels& columns = job_.parcels->parcels;
      parcels.emplace(command.out, rows, columns.count, MatrixNumber::float64, journal.resumed());
      outputs.push_back({*parcels, [&](DenseRow<Real> row) { return parcel_means(row, columns); }});
    }
    if (job_.wants_statistics()) {
      statistics.emplace(command.stats.empty() ? command.histogram : command.stats, rows,
                         job_.statistics_columns(), MatrixNumber::float64, journal.resumed());
      outputs.push_back({*statistics, [&](DenseRow<Real> row) {
                           return statistics_row(row, command.bin_width.value_or(1),
                                                 command.histogram.empty() ? 0 : command.bins);
                         }});
    }
    const Stopwatch watch;
    outcome_.report = io::write_pairs(executor_, complex_, request_,
                                      std::span<const io::RowOutput<Real>>(outputs), journal);
    outcome_.solving = watch.seconds();
    if (matrix) finish_matrix(*matrix, journal);
    if (parcels) {
      write_parcels(command.out, *parcels, *job_.parcels);
      parcels->remove();
    }
    finish_statistics(statistics ? &*statistics : nullptr);
  }

  void finish_matrix(MatrixFile& matrix, BlockJournal& journal) {
    if (job_.square) {
      progress_.phase("comparing the two ways");
      // Told once: by then some may have been made symmetric.
      if (journal.noted().empty()) journal.note(asymmetry_text(asymmetry_of(matrix)));
      outcome_.asymmetry = journal.noted();
      if (job_.command.symmetric) make_symmetric(matrix);
    }
    journal.complete([&] { matrix.sync(); });
    matrix.commit();
  }

  void finish_statistics(MatrixFile* statistics) {
    if (statistics == nullptr) return;
    outcome_.statistics =
        write_statistics(job_.command.stats, job_.command.histogram,
                         job_.command.bin_width.value_or(1), *statistics, job_.rows, job_.columns);
    statistics->remove();
  }

  const Job& job_;
  const E& executor_;
  const Complex& complex_;
  ProgressLine& progress_;
  PairsRequest request_;
  Outcome outcome_;
};

template <class Real, class Shape>
Outcome run_on(const Shape& whole, const MeasuredLengths* all_lengths, const Job& job,
               ProgressLine& progress) {
  progress.phase("building");
  std::optional<Shape> open;
  std::optional<MeasuredLengths> open_lengths;
  if (job.mask) {
    if (all_lengths != nullptr) open_lengths = *all_lengths;
    open = open_shape(*job.mask, whole, open_lengths ? &*open_lengths : nullptr);
  }
  const Shape& shape = open ? *open : whole;
  const MeasuredLengths* lengths = open_lengths ? &*open_lengths : all_lengths;
  const auto with = [&](const auto& complex, const std::vector<PointSource>& rows) {
    const std::string& name = job.command.solve.executor.name;
    if (name == "serial" || !openmp_built())
      return MatrixRun(job, Serial{}, complex, rows, progress).run();
    const OpenMP team{.threads = job.command.solve.executor.threads.value_or(0)};
    return MatrixRun(job, team, complex, rows, progress).run();
  };
  if constexpr (std::is_same_v<Shape, io::Triangles>) {
    TriangulationReport report;
    const auto made =
        make_surface<Real>(triangulation_of(job.command.triangulation), shape, lengths, report);
    if (!made.delaunay) return with(made.mesh, job.rows);
    std::vector<PointSource> moved;
    for (const PointSource& point : job.rows) moved.push_back(made.delaunay->to_intrinsic(point));
    return with(made.mesh, moved);
  } else {
    return with(make_complex<Real>(shape, lengths), job.rows);
  }
}

void print(const MatrixCommand& command, const Job& job, const Outcome& outcome) {
  Json json;
  Table table;
  json["input"] = command.input;
  json["kind"] = job.domain.kind();
  json["rows"] = job.rows.size();
  json["columns"] = job.columns.size();
  table.add("input", command.input);
  table.add("matrix", std::to_string(job.rows.size()) + " x " + std::to_string(job.columns.size()));
  if (outcome.only_estimated) {
    json["estimate"] = {{"seconds", outcome.expected_seconds}, {"bytes", outcome.expected_bytes}};
    table.add("estimate", short_time(outcome.expected_seconds) + " on " +
                              counted(outcome.threads, "threads") +
                              (job.sparse ? "" : ", " + io::short_bytes(outcome.expected_bytes)));
  } else {
    json["rows_solved"] = outcome.report.rows;
    json["blocks_kept"] = outcome.resumed_blocks;
    json["threads"] = outcome.threads;
    json["expansions"] = outcome.report.statistics.expansions;
    json["seconds"] = outcome.solving;
    table.add("work", counted(outcome.report.rows, "rows") + " solved, " +
                          counted(outcome.report.statistics.expansions, "expansions"));
    table.add("time", short_time(outcome.solving));
    if (job.sparse) {
      json["entries"] = outcome.entries;
      table.add("entries", std::to_string(outcome.entries));
    }
    if (!outcome.asymmetry.empty()) {
      std::array<double, 4> number{};
      std::sscanf(outcome.asymmetry.c_str(), "%lf %lf %lf %lf", &number[0], &number[1], &number[2],
                  &number[3]);
      json["asymmetry"] = {{"largest", number[0]}, {"mean", number[1]}, {"one_way", number[3]}};
      table.add("two ways", "differ by " + short_number(number[1]) +
                                " of the shorter on average, " + short_number(number[0]) +
                                " at most" +
                                (command.symmetric ? "; the shorter counts for both" : ""));
    }
    if (outcome.statistics) add_statistics(*outcome.statistics, json, table);
    add_written(table, {command.out, command.stats, command.histogram});
  }
  if (command.json)
    write_output(json_text(json));
  else if (!command.quiet)
    write_output(table.text());
  flush_output();
}

}  // namespace

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

void run_matrix(const MatrixCommand& command) {
  const PropagateOptions options = propagate_options(command.solve);
  const Precision precision = precision_of(command.solve);
  if (command.solve.executor.name == "gl")
    throw UsageError("--executor gl: rows of a matrix are solved one a thread; choose openmp");
  check_names(command);
  const MatrixNumber number = io::matrix_number_of(command.type);
  const Triangulation triangulation = triangulation_of(command.triangulation);
  ProgressLine progress(command.quiet);
  const Domain domain =
      Domain::load(command.input, command.as, command.fill, command.cloud, progress);
  check_triangulation(triangulation, domain);

  Job job{.command = command,
          .domain = domain,
          .sparse = command.radius || command.nearest,
          .number = number,
          .options = options};
  if (command.targets.empty() || command.targets == "all") {
    job.columns.resize(domain.vertices());
    std::iota(job.columns.begin(), job.columns.end(), Index{0});
  } else {
    job.columns = read_vertex_list(command.targets, domain, "--targets");
  }
  if (command.sources == "all") {
    for (Index v = 0; v < domain.vertices(); ++v) job.rows.push_back(PointSource::at(v));
  } else {
    job.rows = read_point_list(command.sources, domain);
  }
  job.mask = read_mask(command.mask, domain);
  if (job.mask && command.sources != "all") move_sources(*job.mask, domain, job.rows);
  if (!command.labels.empty()) {
    job.parcels = read_parcels(command.labels, domain.vertices());
    job.parcels->take(job.rows, job.columns, command.labels);
  }
  job.square =
      std::equal(job.rows.begin(), job.rows.end(), job.columns.begin(), job.columns.end(),
                 [](const PointSource& row, Index column) { return row.vertex == column; });
  if (command.symmetric && !job.square)
    throw UsageError("--symmetric: --sources and --targets must be the same vertices");
  if (!command.metric.text.empty()) progress.phase("reading the metric");
  const auto lengths = measure(command.metric, domain, Jumps::refract);
  describe(job, lengths.get());

  const Outcome outcome = with_file_name(domain, [&] {
    return std::visit(
        [&](const auto& shape) {
          return precision == Precision::single
                     ? run_on<float>(shape, lengths.get(), job, progress)
                     : run_on<double>(shape, lengths.get(), job, progress);
        },
        domain.shape());
  });
  progress.clear();
  print(command, job, outcome);
  if (!command.quiet) say_violations(domain, lengths.get());
}

}  // namespace plexway::cli
