#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>

#include <plexway/common/ids.hpp>

namespace plexway::openvdb {

/// What no path leads to, and all outside the solid.
inline constexpr float outside = -1;

/// How a field becomes a volume.
struct FieldOptions {
  double voxel = 0;  ///< side, in the unit of positions; 0: half the solid's mean edge
  /// Of the grid.
  std::string name = "distance";
};

/// Writes a field on a solid as a `FloatGrid`: one distance a vertex, linear in each tetrahedron.
///
/// The voxels whose centre lies in the solid are active, and there are no others; voxels lie at
/// multiples of the voxel's side, by the grid's transform. The background, outside, is -1, which no
/// distance is; tetrahedra with a vertex that is not reached count as outside. The class is unknown
/// (neither a level set nor a fog); the name is "distance", as Houdini, Blender and ParaView show
/// it. Where `label` is not empty, a second grid "label" (Int32) has that of the nearest corner.
/// The file appears whole or not at all.
///
/// Returns the number of active voxels. Throws UsageError for arrays of wrong length or a voxel out
/// of range, Error "cannot write FILE: reason". Cost: 0.1 us a voxel, and less for each row of
/// voxels along z that comes near a tetrahedron.
std::size_t write_field(const std::filesystem::path& file,
                        std::span<const std::array<double, 3>> positions,
                        std::span<const std::array<Index, 4>> tets,
                        std::span<const double> distance, std::span<const std::int32_t> label = {},
                        const FieldOptions& options = {});

}  // namespace plexway::openvdb
