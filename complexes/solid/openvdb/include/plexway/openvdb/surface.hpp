#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <string>

#include <plexway/common/ids.hpp>
#include <plexway/openvdb/level_set.hpp>

namespace plexway::openvdb {

/// What was wrong with a surface, and what was done about it. Lengths in the input's unit.
struct Repair {
  double voxel = 0;            ///< side, as given or chosen
  std::size_t degenerate = 0;  ///< triangles without area, on a line or a point, left out
  std::size_t doubled = 0;     ///< triangles there before, left out
  std::size_t open_edges = 0;  ///< of an odd number of triangles
  std::size_t holes = 0;       ///< rims of such edges, each closed by a fan
  double largest_hole = 0;     ///< diagonal of the box around the largest rim
  std::size_t sheets = 0;      ///< parts that are more hole than surface, left out
  /// Triangles of these sheets.
  std::size_t sheet_triangles = 0;

  /// "voxel 0.01; 3 holes closed, the largest 0.2 across": for people, without an end of line.
  [[nodiscard]] std::string text() const;
};

/// How to make a level set of a surface.
struct SurfaceOptions {
  /// Side of a voxel, in the input's unit; 0: half the mean edge, but 32 to 128 of them along the
  /// diagonal of the surface's box.
  double voxel = 0;
  /// Where it says what was done; may be null.
  Repair* report = nullptr;
};

/// The level set of what a surface encloses: all that cannot be reached from outside without
/// passing through it.
///
/// So triangles may cross, overlap, be there twice and look either way. Rims of holes are closed by
/// a fan about their middle, whatever their size, unless the fans of a part have more than 0.6 of
/// its area: then it is a sheet, not a surface with holes, and left out. What is thinner than two
/// voxels may be lost, and gaps narrower than one are closed.
///
/// Throws InputError for no triangle, an index out of range, a coordinate that is not finite, or a
/// surface that encloses nothing, and says why; UsageError for a voxel out of range. Cost: linear
/// in area over voxel squared, about 1 us a voxel near the surface. Source: OpenVDB's meshToVolume.
[[nodiscard]] LevelSet level_set_of(std::span<const std::array<double, 3>> positions,
                                    std::span<const std::array<Index, 3>> triangles,
                                    const SurfaceOptions& options = {});

}  // namespace plexway::openvdb
