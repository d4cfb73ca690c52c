#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <span>
#include <string>

#include <plexway/executors.hpp>

namespace plexway {

/// What is taken from HDF5, behind a module since its library loads thirty others.
struct Hdf5Functions {
  /// As hdf5::write_matrix.
  void (*write_matrix)(
      const std::filesystem::path& file, std::array<std::size_t, 2> shape, std::size_t number_bytes,
      const std::function<void(std::size_t row, std::size_t column, std::span<char> bytes)>& read,
      std::span<const std::int64_t> row_names, std::span<const std::int64_t> column_names,
      const OpenMP& threads);
};

/// Throws NotBuiltError, which starts with `what` and names the package, where this build has no
/// HDF5; Error where the module was not installed beside the tool.
const Hdf5Functions& hdf5_functions(const std::string& what);

}  // namespace plexway
