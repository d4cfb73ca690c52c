#include "shape/pairs/pair_files.hpp"

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <functional>
#include <span>
#include <type_traits>
#include <utility>
#include <variant>

#include <plexway/error.hpp>
#include <plexway/io/write_pairs.hpp>
#include <plexway/pairs/all_pairs.hpp>
#include <plexway/pairs/block_rows.hpp>
#include <plexway/pairs/row_reductions.hpp>
#include <plexway/shape/complex.hpp>
#include <plexway/support.hpp>

#ifdef PLEXWAY_HAS_GL
#include <plexway/executors/gl.hpp>
#endif

#include "io/names.hpp"
#include "shape/inside.hpp"
#include "shape/modules/module.hpp"
#include "shape/stopwatch.hpp"
#include "shape/with_executor.hpp"
#include "shape/words.hpp"

namespace plexway::detail {
namespace {

namespace fs = std::filesystem;
using io::BlockJournal;
using io::MatrixFile;
using io::MatrixNumber;

std::string text_of(const io::Asymmetry& found) {
  return short_number(found.largest) + " " + short_number(found.mean) + " " +
         std::to_string(found.pairs) + " " + std::to_string(found.one_way);
}

io::Asymmetry asymmetry_in(const std::string& text) {
  io::Asymmetry found;
  std::sscanf(text.c_str(), "%lf %lf %zu %zu", &found.largest, &found.mean, &found.pairs,
              &found.one_way);
  return found;
}

/// What a run has: the domain and the files, and whom it tells.
struct PairWork {
  const AnyShape& domain;  // all of it
  const PairFiles& files;
  const PairFilesProgress& progress;
  RowRanks* ranks = nullptr;
  bool only_estimate = false;

  void stage(std::string_view what) const {
    if (progress.stage) progress.stage(what);
  }
  void note(const std::string& text) const {
    if (progress.note) progress.note(text);
  }
  [[nodiscard]] std::size_t blocks() const {
    return (files.rows.size() + files.block - 1) / files.block;
  }
  /// Beside which file the journal is.
  [[nodiscard]] const std::string& main_file() const {
    return !files.matrix.empty()       ? files.matrix
           : !files.statistics.empty() ? files.statistics
                                       : files.histogram;
  }
  [[nodiscard]] bool wants_matrix() const { return !files.matrix.empty() && !files.parcels; }
  [[nodiscard]] bool wants_statistics() const {
    return !files.statistics.empty() || !files.histogram.empty();
  }
  [[nodiscard]] std::size_t bins() const { return files.histogram.empty() ? 0 : files.bins; }
  /// Numbers of a row that the statistics keep.
  [[nodiscard]] std::size_t statistics_columns() const { return 4 + bins(); }

  /// On the disk while it is made, as far as that is known before: HDF5 is made of what lies beside
  /// it, and may not get smaller.
  [[nodiscard]] double expected_bytes() const {
    const std::size_t rows = files.rows.size();
    double bytes = 0;
    if (wants_matrix() && !files.sparse())
      bytes += MatrixFile::bytes(rows, files.columns.size(), files.number) *
               (is_hdf5(files.matrix) ? 2 : 1);
    if (files.parcels)
      bytes += MatrixFile::bytes(rows, files.parcels->parcels.count, MatrixNumber::float64);
    if (wants_statistics())
      bytes += MatrixFile::bytes(rows, statistics_columns(), MatrixNumber::float64);
    return bytes;
  }

  /// All that the files depend on.
  [[nodiscard]] BlockJournal::Description description(const AnyExecutor& executor) const {
    PairsRequest request;
    request.rows = SourceList(files.rows);
    request.columns = files.columns;
    request.solve = files.solve;
    if (files.radius) request.solve.radius = *files.radius;
    BlockJournal::Description lines = description_of(domain, files.building, request);
    if (std::holds_alternative<GL>(executor))  // the others have one's bits
      lines.emplace_back("executor", "gl");
    const auto print = [&](const char* name, const auto&... numbers) {
      io::Fingerprint found;
      (found.add_numbers(numbers), ...);
      lines.emplace_back(name, found.text());
    };
    if (files.nearest) lines.emplace_back("nearest", std::to_string(*files.nearest));
    if (files.parcels) print("labels", files.parcels->parcels.of);
    if (wants_matrix()) lines.emplace_back("type", std::string(io::name_of(files.number)));
    if (files.symmetric) lines.emplace_back("symmetric", "yes");
    if (!files.histogram.empty())
      lines.emplace_back("histogram",
                         exact_number(files.bin_width) + " " + std::to_string(files.bins));
    std::string written;
    for (const std::string* name : {&files.matrix, &files.statistics, &files.histogram})
      if (!name->empty())
        written += (written.empty() ? "" : " ") + fs::path(*name).filename().string();
    lines.emplace_back("written", written);
    return lines;
  }
};

/// Rows of a complex by an executor, in this process; both are known to these functions alone.
template <class Real>
struct RowSolver {
  std::size_t threads;
  std::function<PairsReport(const PairsRequest&, const PairsSink<DenseRow<Real>>&)> dense;
  std::function<PairsReport(const PairsRequest&, const NearLimits&,
                            const PairsSink<SparseRow<Real>>&)>
      near;
};

template <class E, class Complex>
RowSolver<io::RowReal<Complex>> row_solver(const E& executor, const Complex& complex) {
  RowSolver<io::RowReal<Complex>> solver = {1, {}, {}};
  if constexpr (std::is_same_v<E, OpenMP>) solver.threads = team_size(executor);
  solver.dense = [&](const PairsRequest& request, const auto& sink) {
    if constexpr (RowExecutor<E>)
      return all_pairs(executor, complex, request, sink);
    else
      return all_pairs_by_blocks(executor, complex, request, sink);
  };
  solver.near = [&](const PairsRequest& request, const NearLimits& limits, const auto& sink) {
    if constexpr (RowExecutor<E>)
      return near_pairs(executor, complex, request, limits, sink);
    else
      return PairsReport{};  // refused
  };
  return solver;
}

/// Solves whatever is missing, and finishes the files.
template <class Real>
class PairRun {
 public:
  PairRun(const PairWork& work, const AnyExecutor& executor, const RowSolver<Real>& solver,
          const std::vector<PointSource>& rows, std::span<const Index> columns)
      : work_(work), files_(work.files), executor_(executor), solver_(solver) {
    request_.rows = SourceList(rows);
    request_.columns = columns;
    request_.solve = files_.solve;
    request_.block = files_.block;
  }

  PairFilesReport run() {
    if (work_.ranks != nullptr && !work_.ranks->leads()) {
      follow();
      return report_;
    }
    report_.expected_bytes = work_.expected_bytes();
    report_.threads = solver_.threads;
    report_.ranks = work_.ranks == nullptr ? 1 : work_.ranks->count();
    estimate();
    if (work_.only_estimate) return report_;
    io::check_room(work_.main_file(), report_.expected_bytes);
    BlockJournal journal(work_.main_file(), work_.description(executor_), work_.blocks());
    report_.resumed_blocks = journal.finished();
    if (journal.resumed())
      work_.note("going on with " + work_.main_file() + ": " +
                 counted(journal.finished(), "blocks") + " of " + std::to_string(journal.blocks()) +
                 " are there");
    if (work_.progress.rows)
      request_.progress = [this](const PairsProgress& at) {
        work_.progress.rows(at);
        return true;
      };
    work_.stage("solving");
    if (files_.sparse())
      run_sparse(journal);
    else
      run_dense(journal);
    return report_;
  }

 private:
  // How long it will take, by some rows: what more of them take than less, as the first of each
  // thread make room for what the others find.
  void estimate() {
    const std::size_t rows = files_.rows.size();
    std::size_t probes = 2 * report_.threads;
    if (!work_.only_estimate && rows < 50 * probes) return;
    work_.stage("estimating");
    double before = solve_some(std::min(probes, rows)), seconds = before;
    for (;;) {
      const std::size_t more = std::min(4 * probes, rows);
      seconds = solve_some(more);
      const double each = (seconds - before) / static_cast<double>(std::max(more - probes, 1UL));
      report_.expected_seconds =
          (more > probes && each > 0 ? each : seconds / static_cast<double>(more)) *
          static_cast<double>(rows) / static_cast<double>(report_.ranks);
      if (seconds > 0.05 || 16 * more > rows) break;
      probes = more;
      before = seconds;
    }
    if (work_.only_estimate || report_.expected_seconds < 5) return;
    std::string text = std::to_string(rows) + " x " + std::to_string(files_.columns.size()) +
                       ": about " + short_time(report_.expected_seconds) + " on " + report_.team();
    if (report_.expected_bytes > 0) text += ", " + io::short_bytes(report_.expected_bytes);
    work_.note(text + "; what is finished stays if it is ended before");
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
    if (files_.sparse())
      solver_.near(few, limits(), {[](std::size_t, SparseRow<Real>) {}});
    else
      solver_.dense(few, {[](std::size_t, DenseRow<Real>) {}});
    return watch.seconds();
  }

  [[nodiscard]] NearLimits limits() const {
    return {.radius = files_.radius.value_or(NearLimits{}.radius),
            .nearest = files_.nearest.value_or(none)};
  }

  // Alone or among others.
  PairsReport dense_rows(const PairsRequest& request, const PairsSink<DenseRow<Real>>& sink) {
    if (work_.ranks == nullptr) return solver_.dense(request, sink);
    return share_rows(*work_.ranks, request, work_.domain.vertices(), sink, solver_.dense);
  }
  PairsReport near_rows(const PairsRequest& request, const PairsSink<SparseRow<Real>>& sink) {
    const auto solve = [&](const PairsRequest& mine, const PairsSink<SparseRow<Real>>& out) {
      return solver_.near(mine, limits(), out);
    };
    if (work_.ranks == nullptr) return solve(request, sink);
    return share_rows(*work_.ranks, request, work_.domain.vertices(), sink, solve);
  }

  // Rows go to the leader, which has the files.
  void follow() {
    if (work_.only_estimate) return;
    if (files_.sparse())
      near_rows(request_, {});
    else
      dense_rows(request_, {});
  }

  void run_sparse(BlockJournal& journal) {
    io::SparseFile file(files_.matrix, files_.rows.size(), files_.columns.size(), files_.block,
                        files_.number, journal);
    const Stopwatch watch;
    report_.solved = io::write_near_rows<Real>(
        request_, file, journal,
        [&](const auto& missing, const auto& sink) { return near_rows(missing, sink); });
    report_.seconds = watch.seconds();
    work_.stage("writing " + files_.matrix);
    report_.entries = file.commit(journal);
    // The journal goes first: one without its part could not be gone on with.
    journal.remove();
    file.remove();
  }

  void run_dense(BlockJournal& journal) {
    const std::size_t rows = files_.rows.size();
    if (journal.is_complete() && !fs::exists(io::PartFile::path_of(files_.matrix))) {
      journal.remove();  // ended when all was in its place
      return;
    }
    std::optional<MatrixFile> matrix, parcels, statistics;
    std::vector<io::RowOutput<Real>> outputs;
    if (work_.wants_matrix()) {
      matrix.emplace(files_.matrix, rows, files_.columns.size(), files_.number, journal.resumed());
      outputs.push_back({*matrix});
    }
    if (files_.parcels) {
      const Parcels& columns = files_.parcels->parcels;
      parcels.emplace(files_.matrix, rows, columns.count, MatrixNumber::float64, journal.resumed());
      outputs.push_back({*parcels, [&](DenseRow<Real> row) { return parcel_means(row, columns); }});
    }
    if (work_.wants_statistics()) {
      statistics.emplace(files_.statistics.empty() ? files_.histogram : files_.statistics, rows,
                         work_.statistics_columns(), MatrixNumber::float64, journal.resumed());
      outputs.push_back({*statistics, [&](DenseRow<Real> row) {
                           return statistics_row(row, files_.bin_width, work_.bins());
                         }});
    }
    const Stopwatch watch;
    report_.solved = io::write_rows(
        request_, std::span<const io::RowOutput<Real>>(outputs), journal,
        [&](const auto& missing, const auto& sink) { return dense_rows(missing, sink); });
    report_.seconds = watch.seconds();
    if (matrix && files_.square()) compare_ways(*matrix, journal);
    if (parcels) write_parcels(files_.matrix, *parcels, *files_.parcels);
    if (statistics)
      report_.statistics = write_statistics(files_.statistics, files_.histogram, files_.bin_width,
                                            *statistics, files_.rows, files_.columns);
    // Ended before this line all is done again from the parts, and behind it nothing.
    if (matrix) {
      journal.complete([&] { matrix->sync(); });
      if (is_hdf5(files_.matrix))
        write_hdf5(*matrix);
      else
        matrix->commit();
    }
    journal.remove();
    if (matrix && is_hdf5(files_.matrix)) matrix->remove();
    if (parcels) parcels->remove();
    if (statistics) statistics->remove();
  }

  void compare_ways(MatrixFile& matrix, BlockJournal& journal) {
    work_.stage("comparing there and back");
    // Told once: by then some may have been made symmetric.
    if (journal.noted().empty()) journal.note(text_of(asymmetry_of(matrix)));
    report_.asymmetry = asymmetry_in(journal.noted());
    if (files_.symmetric) make_symmetric(matrix);
  }

  void write_hdf5(const MatrixFile& matrix) {
    const std::string& out = files_.matrix;
    work_.stage("writing " + out);
    std::vector<std::int64_t> rows, columns(files_.columns.begin(), files_.columns.end());
    for (const PointSource& row : files_.rows)
      rows.push_back(row.vertex == none ? -1 : std::int64_t{row.vertex});
    const auto read = [&](std::size_t row, std::size_t column, std::span<char> bytes) {
      matrix.read_bytes(row, column, bytes);
    };
    hdf5_functions(out).write_matrix(out, {matrix.rows(), matrix.columns()},
                                     io::size_of(files_.number), read, rows, columns,
                                     OpenMP{.threads = static_cast<int>(report_.threads)});
  }

  const PairWork& work_;
  const PairFiles& files_;
  const AnyExecutor& executor_;
  const RowSolver<Real>& solver_;
  PairsRequest request_;
  PairFilesReport report_;
};

PairFilesReport run_on(const PairWork& work, const AnyExecutor& executor) {
  work.stage("building");
  BuildOptions building = work.files.building;
  if (work.domain.kind() != DomainKind::surface) building.triangulation = Triangulation::input;
  const AnyDomain built(work.domain, building);
  const RowComplex of_rows = row_complex(built, work.files.rows);
  const std::vector<Index> columns = built.open_simplices() == nullptr
                                         ? work.files.columns
                                         : built.open_simplices()->columns(work.files.columns);
  PairFilesReport report;
  const auto run = [&](const auto& chosen, const auto& complex) {
    const auto solver = row_solver(chosen, complex);
    report = PairRun(work, executor, solver, of_rows.rows, columns).run();
  };
  std::visit(
      [&](const auto& complex) {
        using Pointer = std::decay_t<decltype(complex)>;
        if constexpr (std::is_same_v<Pointer, std::monostate>)  // a mixed domain
          with_executor<MixedComplex<float>>(executor,
                                             [&](const auto& chosen) { run(chosen, built); });
        else
          with_executor<std::decay_t<decltype(*complex)>>(
              executor, [&](const auto& chosen) { run(chosen, *complex); });
      },
      of_rows.complex);
  report.warnings = domain_warnings(built, work.files.reader);
  for (Warning& one : rows_warnings(built, report.solved.statistics, work.files.solve.accuracy,
                                    report.solved.rows, work.files.reader))
    report.warnings.push_back(std::move(one));
  return report;
}

PairFilesReport run_on_named(const PairWork& work, const AnyExecutor& executor) {
  try {
    return run_on(work, executor);
  } catch (const InputError& error) {  // AnyDomain, where it is one, has said it itself
    const std::string file = work.domain.file().string();
    if (file.empty() || std::string_view(error.what()).starts_with(file)) throw;
    throw InputError(file + ": " + error.what());
  }
}

}  // namespace

bool PairFiles::square() const {
  return std::equal(rows.begin(), rows.end(), columns.begin(), columns.end(),
                    [](const PointSource& row, Index column) { return row.vertex == column; });
}

bool is_hdf5(const std::string& file) { return io::lower_extension(file) == ".h5"; }

std::string PairFilesReport::team() const {
  const std::string each = counted(threads, "threads");
  return ranks == 1 ? each : counted(ranks, "ranks") + ", here of " + each;
}

PairFilesReport write_pair_files(const AnyExecutor& executor, const AnyShape& domain,
                                 const PairFiles& files, const PairFilesProgress& progress,
                                 RowRanks* ranks) {
  return run_on_named({domain, files, progress, ranks, false}, executor);
}

PairFilesReport estimate_pair_files(const AnyExecutor& executor, const AnyShape& domain,
                                    const PairFiles& files, const PairFilesProgress& progress,
                                    RowRanks* ranks) {
  return run_on_named({domain, files, progress, ranks, true}, executor);
}

}  // namespace plexway::detail
