#pragma once

#include <array>
#include <cstddef>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include <plexway/common/ids.hpp>
#include <plexway/io/points.hpp>

namespace plexway {

/// What is taken from PCL.
///
/// PCL's libraries bring VTK along: to load them takes 50 ms and 50 MB, twenty times what the tool
/// takes without. So they are behind a module that is loaded when one of these is needed.
struct PclFunctions {
  /// As pcl::read_points; `dropped` counts points that were not finite.
  io::Points (*read_points)(const std::filesystem::path& file, std::size_t& dropped);
  void (*write_field)(const std::filesystem::path& file,
                      std::span<const std::array<double, 3>> positions,
                      std::span<const double> distance, std::span<const Index> original);
  std::vector<std::array<double, 3>> (*voxel_grid)(std::span<const std::array<double, 3>> points,
                                                   double size);
  std::vector<Index> (*without_outliers)(std::span<const std::array<double, 3>> points,
                                         double deviations);
};

/// Throws NotBuiltError, which starts with `what` and names the package, where this build has no
/// PCL; Error where the module was not installed beside the tool.
const PclFunctions& pcl_functions(const std::string& what);

}  // namespace plexway
