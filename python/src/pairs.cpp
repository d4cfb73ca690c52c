#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

#include <plexway/error.hpp>
#include <plexway/io/write_pairs.hpp>
#include <plexway/shape/pairs.hpp>

#include "arrays.hpp"
#include "domain.hpp"

namespace plexway::python {
namespace {

// A row each, to columns. Stays where it is: the request refers to it.
struct Matrix {
  Matrix(const Domain& domain, std::vector<Source> given, const py::object& wanted,
         SolveArguments how, py::object progress)
      : sources(std::move(given)),
        executor(executor_of(how)),
        watch(std::move(progress)),
        arguments(std::move(how)) {
    if (!wanted.is_none()) {
      columns = indices_of(wanted, "columns");
      if (columns.empty()) throw UsageError("columns: the list is empty");
    }
    request.rows.emplace(sources.list());
    request.columns = columns;
    request.solve = options_of(arguments, watch);
    request.solve.progress = [this](const Progress&) { return watch.tick(share); };
    request.progress = [this](const PairsProgress& at) {
      share = static_cast<double>(at.rows_done) / static_cast<double>(at.rows);
      return watch.tick(share);
    };
    any = &domain.for_sources(executor, sources.list(), request.solve);
  }
  [[nodiscard]] std::vector<Remark> remarks(const PairsReport& report) const {
    return rows_remarks(*any, report.statistics, arguments.accuracy, report.rows, Reader::python);
  }

  Matrix(const Matrix&) = delete;
  Matrix& operator=(const Matrix&) = delete;

  Sources sources;
  AnyExecutor executor;
  Watch watch;
  SolveArguments arguments;
  std::vector<Index> columns = {};
  PairsRequest request = {};
  const AnyDomain* any = nullptr;
  double share = 0;  // of the rows; of the calling thread
};

NearLimits limits_of(double radius, const std::optional<std::size_t>& nearest) {
  return {.radius = radius, .nearest = nearest.value_or(none)};
}

// Rows of few entries, as scipy.sparse.csr_matrix takes them: (data, columns, starts), and doubts.
py::tuple near(const Domain& domain, std::vector<Source> given, const py::object& columns,
               double radius, const std::optional<std::size_t>& nearest,
               const SolveArguments& arguments, py::object progress) {
  Matrix matrix(domain, std::move(given), columns, arguments, std::move(progress));
  std::vector<std::vector<NearEntry<double>>> rows(matrix.sources.list().size());
  const PairsReport report = matrix.watch.run([&] {
    return near_pairs(matrix.executor, *matrix.any, matrix.request, limits_of(radius, nearest),
                      {.row = [&](std::size_t row, SparseRow<double> content) {
                        rows[row].assign(content.begin(), content.end());
                      }});
  });
  std::vector<double> data;
  std::vector<std::int64_t> indices, starts = {0};
  for (auto& row : rows) {
    for (const auto& [column, distance] : row) {
      indices.push_back(column);
      data.push_back(distance);
    }
    starts.push_back(static_cast<std::int64_t>(indices.size()));
    row = {};
  }
  return py::make_tuple(owned(std::move(data)), owned(std::move(indices)), owned(std::move(starts)),
                        doubts_of(matrix.remarks(report)));
}

// All that the file depends on.
io::BlockJournal::Description description_of(const Domain& domain, const Matrix& matrix,
                                             double radius, const std::string& what,
                                             const std::string& type) {
  BuildOptions building = domain.options();
  building.precision = matrix.any->precision();
  PairsRequest request = matrix.request;
  request.solve.radius = radius;
  auto lines = plexway::description_of(domain.shape(), building, request);
  lines.emplace_back("matrix", what);
  lines.emplace_back("type", type);
  return lines;
}

PairsReport write_dense(const Matrix& matrix, const std::filesystem::path& out, std::size_t rows,
                        std::size_t columns, io::MatrixNumber number, io::BlockJournal& journal) {
  if (journal.is_complete() && !std::filesystem::exists(io::PartFile::path_of(out))) {
    journal.remove();  // ended when all was in its place
    return {};
  }
  io::MatrixFile file(out, rows, columns, number, journal.resumed());
  const PairsReport report =
      io::write_pairs(matrix.executor, *matrix.any, matrix.request, file, journal);
  journal.complete([&] { file.sync(); });
  file.commit();
  journal.remove();
  return report;
}

PairsReport write_sparse(const Matrix& matrix, const std::filesystem::path& out, std::size_t rows,
                         std::size_t columns, io::MatrixNumber number, const NearLimits& limits,
                         io::BlockJournal& journal) {
  io::SparseFile file(out, rows, columns, matrix.request.block, number, journal);
  const PairsReport report =
      io::write_near_pairs(matrix.executor, *matrix.any, matrix.request, limits, file, journal);
  file.commit(journal);
  journal.remove();  // first: a journal without its part could not be gone on with
  file.remove();
  return report;
}

// Into `out`, going on with what an earlier call left. The extension tells dense from sparse.
// Returns doubts of the rows that were solved.
py::tuple pairs_file(const Domain& domain, std::vector<Source> given, const py::object& columns,
                     const std::filesystem::path& out, double radius,
                     const std::optional<std::size_t>& nearest, const std::string& type,
                     std::size_t block, bool restart, const SolveArguments& arguments,
                     py::object progress) {
  Matrix matrix(domain, std::move(given), columns, arguments, std::move(progress));
  if (block == 0) throw UsageError("block: a block of rows must have at least one");
  matrix.request.block = block;
  const io::MatrixNumber number = io::matrix_number_of(type);
  const std::size_t vertices = matrix.any->vertices();
  const std::size_t rows = matrix.request.row_count(vertices);
  const std::size_t width = matrix.request.column_count(vertices);
  const bool dense = out.extension() == ".npy";
  const NearLimits limits = limits_of(radius, nearest);
  std::string what = dense ? "dense" : "sparse";
  if (nearest) what += ", nearest " + std::to_string(*nearest);
  what += " in blocks of " + std::to_string(block);
  const PairsReport report = matrix.watch.run([&]() -> PairsReport {
    if (!restart) io::BlockJournal::discard(out);
    if (dense) io::check_room(out, io::MatrixFile::bytes(rows, width, number));
    io::BlockJournal journal(out, description_of(domain, matrix, radius, what, type),
                             matrix.request.block_count(vertices));
    try {
      return dense ? write_dense(matrix, out, rows, width, number, journal)
                   : write_sparse(matrix, out, rows, width, number, limits, journal);
    } catch (...) {
      if (journal.finished() == 0 && !journal.is_complete()) {  // nothing to go on with
        std::error_code none_such;
        std::filesystem::remove(io::PartFile::path_of(out), none_such);
        journal.remove();
      }
      throw;
    }
  });
  return doubts_of(matrix.remarks(report));
}

}  // namespace

void bind_pairs(py::module_& module) {
  module.def("near", &near);
  module.def("pairs_file", &pairs_file);
}

}  // namespace plexway::python
