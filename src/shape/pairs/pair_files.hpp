#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <plexway/any_domain.hpp>
#include <plexway/io/matrix_file.hpp>
#include <plexway/pairs/all_pairs.hpp>
#include <plexway/pairs/row_ranks.hpp>
#include <plexway/pairs/row_reductions.hpp>
#include <plexway/shape/pairs.hpp>
#include <plexway/shape/warnings.hpp>
#include <plexway/source/point_source.hpp>

namespace plexway::detail {

/// Parcels by the labels that a file gives vertices.
struct ParcelLabels {
  std::vector<std::int64_t> labels;  ///< of each parcel, ascending
  Parcels parcels;                   ///< of vertices, then of columns
  std::vector<Index> of_row;

  /// From vertices to rows and columns: rows without a label are dropped. Throws InputError where
  /// none is left, or a row is no vertex.
  void take(std::vector<PointSource>& rows, const std::vector<Index>& columns,
            const std::string& file);
};

/// As io::read_vertex_labels; below 0 is none. Throws InputError.
[[nodiscard]] ParcelLabels read_parcels(const std::string& file, std::size_t vertices);

/// Means over the rows of each parcel: .npy, or .csv with the labels in front.
void write_parcels(const std::string& out, const io::MatrixFile& rows, const ParcelLabels& parcels);

/// Reached, mean, largest, farthest column, and the bins of a histogram, if any.
template <class Real>
std::vector<double> statistics_row(DenseRow<Real> row, double width, std::size_t bins) {
  const RowStatistics found = row_statistics(row);
  std::vector<double> numbers = {static_cast<double>(found.reached), found.mean, found.largest,
                                 found.farthest == none ? -1 : static_cast<double>(found.farthest)};
  if (bins > 0) {
    const std::vector<double> counts = row_histogram(row, width, bins);
    numbers.insert(numbers.end(), counts.begin(), counts.end());
  }
  return numbers;
}

/// What rows come to together.
struct StatisticsSummary {
  double diameter = 0;   ///< the largest of all
  std::size_t from = 0;  ///< its row
  std::size_t to = 0;    ///< its column's vertex
  double radius = 0;     ///< the least of the rows' largest
  double mean = 0;       ///< of all distances that are reached
  std::size_t pairs = 0;
};

/// Writes the tables that are named, from the rows that `statistics_row` made.
StatisticsSummary write_statistics(const std::string& stats, const std::string& histogram,
                                   double width, const io::MatrixFile& rows,
                                   std::span<const PointSource> sources,
                                   std::span<const Index> columns);

/// A matrix of distances, or what is made of its rows, and which files that goes to; those without
/// a name are not written. Names and numbers are checked by who fills it in.
struct PairFiles {
  std::vector<PointSource> rows;  ///< of the shape, whatever is masked
  std::vector<Index> columns;     ///< vertices
  BuildOptions building;
  PropagateOptions solve;
  ///@{
  /// Only what is near: a sparse matrix, and no other file.
  std::optional<double> radius = {};
  std::optional<std::size_t> nearest = {};
  ///@}
  bool symmetric = false;  ///< the shorter of two ways counts for both; where rows are columns
  std::optional<ParcelLabels> parcels = {};  ///< the matrix is of means between them
  io::MatrixNumber number = io::MatrixNumber::float32;

  std::string matrix;      ///< .npy or .h5; sparse .npz or .mtx; of parcels .npy or .csv
  std::string statistics;  ///< a line a row, .csv
  std::string histogram;   ///< of all distances, .csv
  double bin_width = 1;    ///< of the histogram
  std::size_t bins = 100;
  std::size_t block = 32;          ///< rows that are finished together
  Reader reader = Reader::people;  ///< of what is warned

  [[nodiscard]] bool sparse() const { return radius || nearest; }
  /// Are rows and columns the same vertices, in the same order?
  [[nodiscard]] bool square() const;
};

/// Does the name say HDF5?
[[nodiscard]] bool is_hdf5(const std::string& file);

/// Callbacks while files are made. Any may be empty.
struct PairFilesProgress {
  std::function<void(std::string_view)> stage = {};     ///< what begins
  std::function<void(const PairsProgress&)> rows = {};  ///< how many of them are there
  std::function<void(std::string_view)> note = {};      ///< a line for people
};

/// What there is to tell of them.
struct PairFilesReport {
  PairsReport solved;
  double seconds = 0;  ///< of solving
  ///@{
  /// Before it began: 0 where nobody knows.
  double expected_seconds = 0, expected_bytes = 0;
  ///@}
  std::size_t resumed_blocks = 0;  ///< an earlier run's
  std::optional<io::Asymmetry> asymmetry = {};
  std::uint64_t entries = 0;  ///< of a sparse matrix
  std::optional<StatisticsSummary> statistics = {};
  std::size_t threads = 1, ranks = 1;
  std::vector<Warning> warnings = {};  ///< on the domain, and on the rows that were solved

  /// "2 threads" or "4 ranks, here of 2 threads".
  [[nodiscard]] std::string team() const;
};

/// Solves the rows that are missing and finishes the files: a run that was ended in any way goes on
/// where it was. Rows of surfaces are those of `solve` on the triangles that were requested.
///
/// Where `ranks` share the rows all of them call it, and the leader has the files and the report.
/// Throws as BlockJournal, all_pairs, AnyDomain, and UsageError where the executor does not find
/// what is near; NotBuiltError without HDF5 for .h5.
PairFilesReport write_pair_files(const AnyExecutor& executor, const AnyShape& domain,
                                 const PairFiles& files, const PairFilesProgress& progress,
                                 RowRanks* ranks = nullptr);

/// How long that will take, and how many bytes, by solving some rows; writes nothing.
PairFilesReport estimate_pair_files(const AnyExecutor& executor, const AnyShape& domain,
                                    const PairFiles& files, const PairFilesProgress& progress,
                                    RowRanks* ranks = nullptr);

}  // namespace plexway::detail
