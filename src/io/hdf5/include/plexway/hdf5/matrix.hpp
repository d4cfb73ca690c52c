#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <span>

#include <plexway/executors.hpp>

// Dense matrices as HDF5 files.

/// Matrices as HDF5 files, by libhdf5.
namespace plexway::hdf5 {

/// A matrix that lies elsewhere, and goes into a file in pieces.
struct Matrix {
  ///@{
  /// Its shape; neither is 0.
  std::size_t rows = 0, columns = 0;
  ///@}
  /// Bytes of a number: 2, 4 or 8, IEEE 754, little endian.
  std::size_t number_bytes = 4;
  /// Gives the bytes of numbers of a row from a column on. Any thread may call.
  std::function<void(std::size_t row, std::size_t column, std::span<char> bytes)> read;
  ///@{
  /// What rows and columns are of, such as vertices; or empty.
  std::span<const std::int64_t> row_names = {}, column_names = {};
  ///@}
};

/// Writes `/distance`, rows x columns of float16, 32 or 64, and `/rows`, `/columns` where there are
/// names. Chunks of up to 32 rows and 64 Ki numbers, by HDF5's filters shuffle and deflate (level
/// 1); readable from version 1.8 on. The same bytes whatever the number of threads, which compress.
///
/// The file appears whole or not at all. Memory: two chunks a thread. Cost: about 20 ns a number in
/// processor time.
///
/// Throws UsageError for a shape or size of numbers that is none, what `read` throws, and Error
/// "cannot write FILE: reason".
void write_matrix(const std::filesystem::path& file, const Matrix& matrix,
                  const OpenMP& threads = {});

}  // namespace plexway::hdf5
