#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include <plexway/common/ids.hpp>
#include <plexway/executors.hpp>
#include <plexway/io/points.hpp>
#include <plexway/io/tets.hpp>
#include <plexway/io/triangles.hpp>

namespace plexway::detail {

/// Loads a module and looks up its function. Some providers' libraries take longer to load than all
/// that is done with most files, so they are behind modules that are loaded when they are needed.
/// They lie in LIBDIR/plexway beside the program or the library that has this code, or where the
/// program's RUNPATH says.
///
/// `what` starts the message, `library` is what the module is for. Throws Error where the module
/// was not installed.
void* module_function(const std::string& what, const char* library, const char* file,
                      const char* function);

/// Removes the temporary files of this program and of the modules it has loaded. May be called by a
/// handler of signals.
void remove_unfinished_files() noexcept;

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

/// What is taken from OpenVDB, behind a module since its libraries take 30 ms to load.
///
/// `voxel` is 0 where it is to be chosen; `note` hears what came of it, for people: the voxel,
/// and what was repaired.
struct OpenvdbFunctions {
  /// What lies inside the level set of a file, and its boundary. `voxel` is the lattice's spacing.
  io::Tets (*solid_of_file)(const std::filesystem::path& file, const std::string& grid,
                            double voxel, std::string& note);
  io::Triangles (*surface_of_file)(const std::filesystem::path& file, const std::string& grid,
                                   double voxel, std::string& note);
  /// What a surface encloses, by a level set, and its boundary.
  io::Tets (*solid_inside)(const io::Triangles& surface, double voxel, std::string& note);
  io::Triangles (*repaired)(const io::Triangles& surface, double voxel, std::string& note);
  void (*write_level_set)(const std::filesystem::path& file, const io::Triangles& surface,
                          double voxel, std::string& note);
  /// Returns the number of active voxels.
  std::size_t (*write_field)(const std::filesystem::path& file, const io::Tets& solid,
                             std::span<const double> distance, std::span<const std::int32_t> label,
                             double voxel);
};

/// Throws NotBuiltError, which starts with `what` and names the package, where this build has no
/// OpenVDB; Error where the module was not installed beside the tool.
const OpenvdbFunctions& openvdb_functions(const std::string& what);

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

}  // namespace plexway::detail
