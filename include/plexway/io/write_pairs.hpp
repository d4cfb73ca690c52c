#pragma once

#include <cstddef>
#include <functional>
#include <span>
#include <vector>

#include <plexway/io/block_journal.hpp>
#include <plexway/io/matrix_file.hpp>
#include <plexway/io/sparse_file.hpp>
#include <plexway/pairs/all_pairs.hpp>

// Matrices of distances into files, in blocks that a journal remembers: what a run did not finish
// the next one does.
//
//   PairsRequest request;                                  // all rows, all columns
//   const auto rows = request.row_count(n), columns = request.column_count(n);
//   BlockJournal journal("d.npy", {{"mesh", ...}}, request.block_count(n));
//   MatrixFile file("d.npy", rows, columns, MatrixNumber::float32, journal.resumed());
//   write_pairs(OpenMP{}, mesh, request, file, journal);
//   file.commit();
//   journal.remove();

namespace plexway::io {

/// What a domain's rows are handed over in.
template <class D>
struct RowNumber {
  /// Its own numbers; double where they are hidden (shape/pairs.hpp).
  using Type = RealOf<D>;
};
/// The same.
template <class D>
using RowReal = typename RowNumber<D>::Type;

namespace detail {

/// Runs `solve` for what the journal lacks, and keeps what is finished if it ends by an error.
template <class Solve>
PairsReport run_with_journal(PairsRequest request, BlockJournal& journal,
                             const std::function<void()>& sync, const Solve& solve) {
  request.wanted = [&journal](std::size_t block) { return !journal.has(block); };
  PairsReport report;
  try {
    report = solve(request);
  } catch (...) {
    try {
      journal.flush(sync);
    } catch (...) {  // the first error is the one to tell
    }
    throw;
  }
  journal.flush(sync);
  return report;
}

}  // namespace detail

/// What is made of a row of distances, and into which file it goes.
template <class Real>
struct RowOutput {
  /// With a row for each of the request's.
  MatrixFile& file;
  /// Of all columns of the request, to those of the file; empty: the row as it is. Any thread.
  std::function<std::vector<double>(DenseRow<Real>)> made = {};
};

/// The rows that the journal lacks, into one file or several at once, by `solve(request, sink)`:
/// all_pairs, or who shares rows with others. `wanted` is not asked for. Throws as `solve`,
/// BlockJournal and MatrixFile; what was finished before stays.
template <class Real, class Solve>
PairsReport write_rows(const PairsRequest& request, std::span<const RowOutput<Real>> outputs,
                       BlockJournal& journal, const Solve& solve) {
  const auto sync = [&] {
    for (const auto& output : outputs) output.file.sync();
  };
  const PairsSink<DenseRow<Real>> sink = {
      [&](std::size_t row, DenseRow<Real> distance) {
        for (const auto& output : outputs) {
          if (output.made)
            output.file.template write_row<double>(row, output.made(distance));
          else
            output.file.write_row(row, distance);
        }
      },
      [&](std::size_t block) { journal.finish(block, {}, sync); }};
  return detail::run_with_journal(
      request, journal, sync, [&](const PairsRequest& missing) { return solve(missing, sink); });
}

/// The same by `all_pairs`. Any domain that it takes: AnyDomain with shape/pairs.hpp.
template <class E, class D>
PairsReport write_pairs(const E& executor, const D& domain, const PairsRequest& request,
                        std::span<const RowOutput<RowReal<D>>> outputs, BlockJournal& journal) {
  return write_rows(request, outputs, journal, [&](const auto& missing, const auto& sink) {
    return all_pairs(executor, domain, missing, sink);
  });
}

/// Into one file.
template <class E, class D>
PairsReport write_pairs(const E& executor, const D& domain, const PairsRequest& request,
                        MatrixFile& file, BlockJournal& journal) {
  const RowOutput<RowReal<D>> output{file};
  return write_pairs(executor, domain, request, std::span<const RowOutput<RowReal<D>>>(&output, 1),
                     journal);
}

/// The rows that the journal lacks, into a sparse file, by `solve(request, sink)` as above.
template <class Real, class Solve>
PairsReport write_near_rows(const PairsRequest& request, SparseFile& file, BlockJournal& journal,
                            const Solve& solve) {
  const auto sync = [&] { file.sync(); };
  const PairsSink<SparseRow<Real>> sink = {
      [&](std::size_t row, SparseRow<Real> near) {
        std::vector<SparseEntry> entries;
        entries.reserve(near.size());
        for (const auto& [column, distance] : near)
          entries.push_back({column, static_cast<double>(distance)});
        file.write_row(row, entries);
      },
      [&](std::size_t block) { journal.finish(block, file.finish_block(block), sync); }};
  return detail::run_with_journal(
      request, journal, sync, [&](const PairsRequest& missing) { return solve(missing, sink); });
}

/// The same by `near_pairs`.
template <class E, class D>
PairsReport write_near_pairs(const E& executor, const D& domain, const PairsRequest& request,
                             const NearLimits& limits, SparseFile& file, BlockJournal& journal) {
  return write_near_rows<RowReal<D>>(request, file, journal,
                                     [&](const auto& missing, const auto& sink) {
                                       return near_pairs(executor, domain, missing, limits, sink);
                                     });
}

}  // namespace plexway::io
