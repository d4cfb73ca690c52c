// The tool's module for HDF5: see shape/modules/module.hpp.

#include <io/hdf5/include/plexway/hdf5/matrix.hpp>

#include "file/new_file.hpp"
#include "shape/modules/module.hpp"

namespace {

void write_matrix(
    const std::filesystem::path& file, std::array<std::size_t, 2> shape, std::size_t number_bytes,
    const std::function<void(std::size_t row, std::size_t column, std::span<char> bytes)>& read,
    std::span<const std::int64_t> row_names, std::span<const std::int64_t> column_names,
    const plexway::OpenMP& threads) {
  plexway::hdf5::write_matrix(
      file, {shape[0], shape[1], number_bytes, read, row_names, column_names}, threads);
}

constexpr plexway::detail::Hdf5Functions functions = {write_matrix};

}  // namespace

extern "C" const plexway::detail::Hdf5Functions* plexway_hdf5_functions() { return &functions; }
extern "C" void plexway_remove_unfinished() { plexway::detail::file::remove_unfinished(); }
