#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>

#include <plexway/io/tets.hpp>
#include <plexway/io/triangles.hpp>

namespace plexway {

/// What is taken from OpenVDB, behind a module since its libraries take 30 ms to load.
///
/// `voxel` is 0 where it is to be chosen; `note` is told what came of it, for people: the voxel,
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

}  // namespace plexway
