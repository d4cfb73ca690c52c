#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include <plexway/io/matrix_file.hpp>
#include <plexway/pairs/all_pairs.hpp>
#include <plexway/pairs/row_reductions.hpp>
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

}  // namespace plexway::detail
