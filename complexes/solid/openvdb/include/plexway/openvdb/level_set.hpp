#pragma once

#include <array>
#include <cstddef>
#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <string_view>

/// The component `openvdb`, link plexway::openvdb: level sets and volumes, by OpenVDB.
namespace plexway::openvdb {

struct Bricks;

/// A closed shape as a function on a sparse grid: its distance from the surface, negative inside.
/// Known near the surface, of the sign alone elsewhere. Immutable, cheap to copy.
class LevelSet {
 public:
  /// Of a grid made inside the library; not null.
  explicit LevelSet(std::shared_ptr<const Bricks> bricks) : bricks_(std::move(bricks)) {}

  /// The grid's name; empty if it has none.
  [[nodiscard]] const std::string& name() const;
  /// Side of a voxel, in the unit of positions; where voxels are no cubes, that of a cube as large.
  [[nodiscard]] double voxel() const;
  /// Voxels near the surface, whose distance is known.
  [[nodiscard]] std::size_t active_voxels() const;
  /// Voxels whose centre lies inside.
  [[nodiscard]] std::size_t inside_voxels() const;
  /// The value at a place, linear between the voxels' centres. Cost: 8 look-ups.
  [[nodiscard]] double operator()(const std::array<double, 3>& place) const;
  /// Bytes that it holds.
  [[nodiscard]] std::size_t bytes() const;

  /// The grid, for the library's own use.
  [[nodiscard]] const Bricks& bricks() const { return *bricks_; }

 private:
  std::shared_ptr<const Bricks> bricks_;
};

/// Reads a level set, the grid called `grid` or, if that is empty, the file's only level set.
///
/// Grids of float and double, under any transform but a frustum. A grid of unknown class counts as
/// a level set where it is positive outside and negative somewhere.
/// Throws InputError "FILE: cause" for a file that is missing, no .vdb, truncated or damaged, has
/// no such grid or several to choose from (they are named), or whose grid is something else, such
/// as a fog volume, or has no inside. OpenVDB reads in a child process, since damaged files make it
/// crash. Cost: linear in the voxels that are active or lie inside. Source: Museth, VDB:
/// High-Resolution Sparse Volumes with Dynamic Topology, ACM TOG 32 (2013).
[[nodiscard]] LevelSet read_level_set(const std::filesystem::path& file,
                                      std::string_view grid = {});

/// Writes it as a `FloatGrid` of class level set, called `name`, or "surface" as Houdini does. The
/// file appears whole or not at all. Throws Error "cannot write FILE: reason".
void write_level_set(const std::filesystem::path& file, const LevelSet& level_set,
                     std::string_view name = {});

/// A function, negative inside, at the multiples of `voxel` between two corners of a box. Far from
/// the surface it is cut off at three voxels, so it should be about a distance near it. All outside
/// the box counts as outside the shape.
///
/// Throws UsageError for a box or a voxel that makes no sense, InputError where nothing is inside.
/// Cost: a call for each voxel of the box.
[[nodiscard]] LevelSet level_set_of(
    const std::function<double(const std::array<double, 3>&)>& function,
    const std::array<double, 3>& low, const std::array<double, 3>& high, double voxel);

}  // namespace plexway::openvdb
