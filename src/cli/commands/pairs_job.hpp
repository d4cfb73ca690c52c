#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <plexway/complex/mask.hpp>
#include <plexway/io/block_journal.hpp>
#include <plexway/io/matrix_file.hpp>
#include <plexway/propagate/options.hpp>
#include <plexway/source/point_source.hpp>

#include "any/pair_tables.hpp"
#include "cli/commands/pairs_matrix.hpp"
#include "cli/options/input.hpp"

namespace plexway::cli {

/// What is to be made, checked against each other and against the domain.
struct Job {
  const MatrixCommand& command;
  const Domain& domain;
  std::vector<PointSource> rows = {};
  std::vector<Index> columns = {};
  bool square = false;  ///< rows and columns are the same vertices, in the same order
  bool sparse = false;
  io::MatrixNumber number = io::MatrixNumber::float32;
  PropagateOptions options;
  std::shared_ptr<const Mask> mask = nullptr;
  std::optional<ParcelLabels> parcels = {};
  io::BlockJournal::Description description = {};
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

/// Throws UsageError for options and names of files that do not go together. Before anything is
/// read.
void check_names(const MatrixCommand& command);

/// All that the result depends on, a line each, so that what changed can be named.
void describe(Job& job, const MeasuredLengths* lengths);

/// Does the name say HDF5?
[[nodiscard]] bool is_hdf5(const std::string& file);

/// On the disk while it is made, as far as that is known before: HDF5 is made of what lies beside
/// it, and may not get smaller.
[[nodiscard]] double expected_bytes(const Job& job);

}  // namespace plexway::cli
