#include "cli/commands/pairs_matrix.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
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

#include <plexway/any/complex.hpp>
#include <plexway/any_domain.hpp>
#include <plexway/apps/all_pairs.hpp>
#include <plexway/apps/block_rows.hpp>
#include <plexway/apps/row_reductions.hpp>
#include <plexway/error.hpp>
#include <plexway/io/write_pairs.hpp>
#include <plexway/support.hpp>

#ifdef PLEXWAY_HAS_GL
#include <plexway/executors/gl.hpp>
#endif

#include "any/arguments/point_list.hpp"
#include "any/hdf5_functions.hpp"
#include "any/info/report.hpp"
#include "any/make_complex.hpp"
#include "any/pair_tables.hpp"
#include "cli/among.hpp"
#include "cli/commands/pairs_job.hpp"
#include "cli/options/input.hpp"
#include "cli/report/console.hpp"
#include "cli/report/pairs_report.hpp"
#include "cli/report/progress.hpp"

namespace plexway::cli {
namespace {

namespace fs = std::filesystem;
using io::BlockJournal;
using io::MatrixFile;
using io::MatrixNumber;

constexpr double infinity = std::numeric_limits<double>::infinity();

/// What there is to tell.
struct Outcome {
  PairsReport report;
  double solving = 0;  ///< seconds
  double expected_seconds = 0, expected_bytes = 0;
  std::size_t resumed_blocks = 0;
  std::string asymmetry;
  std::uint64_t entries = 0;
  std::optional<StatisticsSummary> statistics;
  std::size_t threads = 1, ranks = 1;
  bool only_estimated = false;

  /// "2 threads" or "4 ranks, here of 2 threads".
  [[nodiscard]] std::string team() const {
    const std::string each = counted(threads, "threads");
    return ranks == 1 ? each : counted(ranks, "ranks") + ", here of " + each;
  }
};

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
      : job_(job),
        among_(job.command.among),
        executor_(executor),
        complex_(complex),
        progress_(progress) {
    request_.rows = SourceList(rows);
    request_.columns = job.columns;
    request_.solve = job.options;
    request_.block = job.block;
  }

  Outcome run() {
    if (among_ != nullptr && !among_->ranks.leads()) {
      follow();
      return outcome_;
    }
    outcome_.expected_bytes = expected_bytes(job_);
    if constexpr (std::is_same_v<E, OpenMP>) outcome_.threads = team_size(executor_);
    outcome_.ranks = among_ == nullptr ? 1 : among_->ranks.count();
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
          static_cast<double>(rows) / static_cast<double>(outcome_.ranks);
      if (seconds > 0.05 || 16 * more > rows) break;
      probes = more;
      before = seconds;
    }
    if (job_.command.estimate || outcome_.expected_seconds < 5) return;
    std::string text = std::to_string(rows) + " x " + std::to_string(job_.columns.size()) +
                       ": about " + short_time(outcome_.expected_seconds) + " on " +
                       outcome_.team();
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
      own_near_rows(few, {[](std::size_t, SparseRow<Real>) {}});
    else
      own_rows(few, {[](std::size_t, DenseRow<Real>) {}});
    return watch.seconds();
  }

  [[nodiscard]] NearLimits limits() const {
    return {.radius = job_.command.radius.value_or(infinity),
            .nearest = job_.command.nearest.value_or(none)};
  }

  // By this process.
  PairsReport own_rows(const PairsRequest& request, const PairsSink<DenseRow<Real>>& sink) {
    if constexpr (RowExecutor<E>)
      return all_pairs(executor_, complex_, request, sink);
    else
      return all_pairs_by_blocks(executor_, complex_, request, sink);
  }
  PairsReport own_near_rows(const PairsRequest& request, const PairsSink<SparseRow<Real>>& sink) {
    if constexpr (RowExecutor<E>)
      return near_pairs(executor_, complex_, request, limits(), sink);
    else
      throw UsageError("--nearest and --radius are looked for by threads");  // refused before
  }

  // Alone or among others.
  PairsReport dense_rows(const PairsRequest& request, const PairsSink<DenseRow<Real>>& sink) {
    const auto solve = [&](const auto& mine, const auto& out) { return own_rows(mine, out); };
    if (among_ == nullptr) return solve(request, sink);
    return share_rows(among_->ranks, request, complex_.vertex_count(), sink, solve);
  }
  PairsReport near_rows(const PairsRequest& request, const PairsSink<SparseRow<Real>>& sink) {
    const auto solve = [&](const auto& mine, const auto& out) { return own_near_rows(mine, out); };
    if (among_ == nullptr) return solve(request, sink);
    return share_rows(among_->ranks, request, complex_.vertex_count(), sink, solve);
  }

  // Rows go to the leader, which has the files.
  void follow() {
    if (job_.command.estimate) return;
    if (job_.sparse)
      near_rows(request_, {});
    else
      dense_rows(request_, {});
  }

  void run_sparse(BlockJournal& journal) {
    io::SparseFile file(job_.command.out, job_.rows.size(), job_.columns.size(), job_.block,
                        job_.number, journal);
    const Stopwatch watch;
    outcome_.report = io::write_near_rows<Real>(
        request_, file, journal,
        [&](const auto& missing, const auto& sink) { return near_rows(missing, sink); });
    outcome_.solving = watch.seconds();
    progress_.phase("writing " + job_.command.out);
    outcome_.entries = file.commit(journal);
    // The journal goes first: one without its part could not be gone on with.
    journal.remove();
    file.remove();
  }

  void run_dense(BlockJournal& journal) {
    const MatrixCommand& command = job_.command;
    const std::size_t rows = job_.rows.size();
    if (journal.is_complete() && !fs::exists(io::PartFile::path_of(command.out))) {
      journal.remove();  // ended when all was in its place
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
    outcome_.report = io::write_rows(
        request_, std::span<const io::RowOutput<Real>>(outputs), journal,
        [&](const auto& missing, const auto& sink) { return dense_rows(missing, sink); });
    outcome_.solving = watch.seconds();
    if (matrix && job_.square) compare_ways(*matrix, journal);
    if (parcels) write_parcels(command.out, *parcels, *job_.parcels);
    if (statistics)
      outcome_.statistics =
          write_statistics(command.stats, command.histogram, command.bin_width.value_or(1),
                           *statistics, job_.rows, job_.columns);
    // Ended before this line all is done again from the parts, and behind it nothing.
    if (matrix) {
      journal.complete([&] { matrix->sync(); });
      if (is_hdf5(command.out))
        write_hdf5(*matrix);
      else
        matrix->commit();
    }
    journal.remove();
    if (matrix && is_hdf5(command.out)) matrix->remove();
    if (parcels) parcels->remove();
    if (statistics) statistics->remove();
  }

  void compare_ways(MatrixFile& matrix, BlockJournal& journal) {
    progress_.phase("comparing the two ways");
    // Told once: by then some may have been made symmetric.
    if (journal.noted().empty()) journal.note(asymmetry_text(asymmetry_of(matrix)));
    outcome_.asymmetry = journal.noted();
    if (job_.command.symmetric) make_symmetric(matrix);
  }

  void write_hdf5(const MatrixFile& matrix) {
    const std::string& out = job_.command.out;
    progress_.phase("writing " + out);
    std::vector<std::int64_t> rows, columns(job_.columns.begin(), job_.columns.end());
    for (const PointSource& row : job_.rows)
      rows.push_back(row.vertex == none ? -1 : std::int64_t{row.vertex});
    const auto read = [&](std::size_t row, std::size_t column, std::span<char> bytes) {
      matrix.read_bytes(row, column, bytes);
    };
    hdf5_functions("--out " + out)
        .write_matrix(out, {matrix.rows(), matrix.columns()}, io::size_of(job_.number), read, rows,
                      columns, OpenMP{.threads = static_cast<int>(outcome_.threads)});
  }

  const Job& job_;
  const Among* among_;
  const E& executor_;
  const Complex& complex_;
  ProgressLine& progress_;
  PairsRequest request_;
  Outcome outcome_;
};

template <class Complex>
Outcome run_on_device(const Job& job, const Complex& complex, const std::vector<PointSource>& rows,
                      ProgressLine& progress) {
#ifdef PLEXWAY_HAS_GL
  if constexpr (supports<GL, Complex>) {
    const GL device{.device = job.command.solve.executor.device.value_or(-1)};
    return MatrixRun(job, device, complex, rows, progress).run();
  }
  support(combination<GL, Complex>()).require();
#endif
  throw NotBuiltError("--executor gl: not built in");
}

template <class Real>
Outcome run_on_surface(const Domain& domain, const MeasuredLengths* lengths, const Job& job,
                       const std::vector<PointSource>& rows, const auto& run) {
  TriangulationReport report;
  const auto made = make_surface<Real>(
      triangulation_of(job.command.triangulation),
      {domain, lengths != nullptr ? lengths : domain.lengths(), job.mask.get()}, report);
  if (!made.delaunay) return run(made.mesh, rows);
  std::vector<PointSource> moved;
  for (const PointSource& point : rows) moved.push_back(made.delaunay->to_intrinsic(point));
  return run(made.mesh, moved);
}

Outcome run_on(const Domain& domain, std::shared_ptr<const MeasuredLengths> lengths,
               Precision precision, const Job& job, ProgressLine& progress) {
  progress.phase("building");
  std::vector<PointSource> inside = job.rows;
  if (job.mask) {
    const OpenSimplices open(*job.mask, domain);
    for (PointSource& row : inside) row = open.inside(row);
  }
  const auto run = [&](const auto& complex, const std::vector<PointSource>& rows) {
    const std::string& name = job.command.solve.executor.name;
    if (name == "gl") return run_on_device(job, complex, rows, progress);
    if (name == "serial" || !openmp_built())
      return MatrixRun(job, Serial{}, complex, rows, progress).run();
    const Among* const among = job.command.among;
    const OpenMP team{.threads = job.command.solve.executor.threads.value_or(
                          among == nullptr ? 0 : among->threads)};
    return MatrixRun(job, team, complex, rows, progress).run();
  };
  if (domain.kind() == DomainKind::surface)
    return precision == Precision::single
               ? run_on_surface<float>(domain, lengths.get(), job, inside, run)
               : run_on_surface<double>(domain, lengths.get(), job, inside, run);
  const AnyDomain built(domain, {.precision = precision,
                                 .triangulation = Triangulation::input,
                                 .lengths = lengths,
                                 .mask = job.mask});
  return with_complex(built, [&](const auto& complex) { return run(complex, inside); });
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
    table.add("estimate", short_time(outcome.expected_seconds) + " on " + outcome.team() +
                              (job.sparse ? "" : ", " + io::short_bytes(outcome.expected_bytes)));
  } else {
    json["rows_solved"] = outcome.report.rows;
    json["blocks_kept"] = outcome.resumed_blocks;
    json["threads"] = outcome.threads;
    if (command.among != nullptr) json["ranks"] = outcome.ranks;
    // Devices count them for all rows of a launch together.
    const bool counts = command.solve.executor.name != "gl";
    if (counts) json["expansions"] = outcome.report.statistics.expansions;
    if (outcome.report.statistics.windows_gave_up > 0)
      json["windows_gave_up"] = outcome.report.statistics.windows_gave_up;
    json["seconds"]["load"] = job.domain.load_seconds();
    if (job.domain.mesh_seconds()) json["seconds"]["mesh"] = *job.domain.mesh_seconds();
    json["seconds"]["solve"] = outcome.solving;
    table.add(
        "work",
        counted(outcome.report.rows, "rows") + " solved" +
            (counts ? ", " + counted(outcome.report.statistics.expansions, "expansions") : ""));
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

void run_matrix(const MatrixCommand& command) {
  const PropagateOptions options = propagate_options(command.solve);
  const Precision precision = precision_of(command.solve);
  const bool by_device = command.solve.executor.name == "gl";
  if (by_device && precision == Precision::twice)
    throw UsageError("--executor gl computes in single precision: use --precision float");
  if (by_device && (command.radius || command.nearest))
    throw UsageError(
        "--executor gl: --radius and --nearest are looked for by threads; choose openmp");
  check_names(command);
  const MatrixNumber number = io::matrix_number_of(command.type);
  const Triangulation triangulation = triangulation_of(command.triangulation);
  ProgressLine progress(command.quiet);
  const Domain domain =
      load_domain(command.input, command.as, command.fill, command.cloud, progress);
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
  if (command.sources != "all") require_open(job.mask.get(), domain, job.rows);
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

  Outcome outcome;
  try {
    outcome = run_on(domain, lengths, precision, job, progress);
  } catch (const InputError& error) {  // of what is built without AnyDomain, which says it itself
    const std::string file = domain.file().string();
    if (std::string_view(error.what()).starts_with(file)) throw;
    throw InputError(file + ": " + error.what());
  }
  progress.clear();
  if (command.among != nullptr && !command.among->ranks.leads()) return;
  print(command, job, outcome);
  if (!command.quiet) say_violations(domain, lengths.get());
  if (!command.quiet) note_accuracy(outcome.report.statistics);
}

}  // namespace plexway::cli
