#pragma once

#include <array>
#include <cstddef>
#include <filesystem>
#include <span>
#include <string_view>
#include <vector>

#include <plexway/common/ids.hpp>

/// The component `pcl`, link plexway::pcl: files and filters of clouds, by PCL.
namespace plexway::pcl {

/// A cloud of points as a file has it, but for points that are not finite: organised clouds have
/// them where the scanner saw nothing.
struct FilePoints {
  /// Finite, in file units.
  std::vector<std::array<double, 3>> positions;
  /// One a point, 0 0 0 where none is known; empty if the file has none.
  std::vector<std::array<double, 3>> normals;
  std::size_t dropped = 0;  ///< points that were not finite
  /// Where some were: the number that each point left has in the file, ascending; else empty.
  std::vector<Index> original;
};

/// Reads .pcd (ascii, binary, binary_compressed; coordinates of any type) or .ply through PCL.
///
/// PCL answers bad files with crashes and with points at the origin, so a .pcd is checked first.
/// Throws InputError, one line "FILE:LINE: cause" or "FILE: cause", for a file that is missing,
/// truncated or malformed, for one without any finite point, and for other extensions. Nothing is
/// printed: PCL's messages are held back meanwhile, in all threads.
FilePoints read_points(const std::filesystem::path& file);

/// The three forms of a .pcd.
enum class PcdForm { ascii, binary, compressed };

/// Writes .pcd in the form asked for or .ply (binary), in single precision, as PCL's types have it.
/// The file appears whole or not at all.
///
/// Throws UsageError for other extensions, no points, and normals that are neither none nor one a
/// point; Error "cannot write FILE: reason" when PCL or the system refuses.
void write_points(const std::filesystem::path& file,
                  std::span<const std::array<double, 3>> positions,
                  std::span<const std::array<double, 3>> normals = {},
                  PcdForm form = PcdForm::compressed);

/// The same with one distance a point as the field `intensity`, to be read into a
/// `pcl::PointCloud<pcl::PointXYZI>`. Unreached points carry +inf. `original`, if not empty, is one
/// number a point, for a field of that name of 32-bit numbers.
void write_field(const std::filesystem::path& file,
                 std::span<const std::array<double, 3>> positions, std::span<const double> distance,
                 PcdForm form = PcdForm::compressed, std::span<const Index> original = {});

/// .pcd and .ply.
std::span<const std::string_view> file_extensions();

}  // namespace plexway::pcl
