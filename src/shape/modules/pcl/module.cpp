// The tool's module for PCL: see shape/modules/module.hpp.

#include <utility>

#include <plexway/pcl/files.hpp>
#include <plexway/pcl/filters.hpp>

#include "file/new_file.hpp"
#include "shape/modules/module.hpp"

namespace {

namespace fs = std::filesystem;
using plexway::detail::PclFunctions;
using Row = std::array<double, 3>;

plexway::io::Points read_points(const fs::path& file, std::size_t& dropped) {
  plexway::pcl::FilePoints read = plexway::pcl::read_points(file);
  dropped = read.dropped;
  return {std::move(read.positions), std::move(read.normals), std::move(read.original)};
}

void write_field(const fs::path& file, std::span<const Row> positions,
                 std::span<const double> distance, std::span<const plexway::Index> original) {
  plexway::pcl::write_field(file, positions, distance, plexway::pcl::PcdForm::compressed, original);
}

std::vector<plexway::Index> without_outliers(std::span<const Row> points, double deviations) {
  plexway::pcl::OutlierOptions options;
  options.deviations = deviations;
  return plexway::pcl::without_outliers(points, options);
}

constexpr PclFunctions functions = {read_points, write_field, plexway::pcl::voxel_grid,
                                    without_outliers};

}  // namespace

extern "C" const PclFunctions* plexway_pcl_functions() { return &functions; }
extern "C" void plexway_remove_unfinished() { plexway::detail::file::remove_unfinished(); }
