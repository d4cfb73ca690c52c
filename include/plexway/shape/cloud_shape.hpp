#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <plexway/cloud/neighbours.hpp>
#include <plexway/common/ids.hpp>
#include <plexway/io/points.hpp>
#include <plexway/shape/read_options.hpp>

namespace plexway {

/// Points with their neighbours. Thinned and denoised points are gone: numbers count those kept,
/// and `points.original` has those in the file.
struct CloudShape {
  /// The points that were kept.
  io::Points points;
  /// Where paths are measured, one a point; empty: at the points.
  std::vector<std::array<double, 3>> smoothed;
  /// Of these.
  Neighbours neighbours;
  std::size_t k = 0;  ///< as requested; 0: all within a radius
  /// Degrees, as requested (CloudOptions).
  std::optional<double> max_normal_angle;

  /// As many as there were.
  std::size_t points_in_file = 0;
  std::size_t not_finite = 0;  ///< dropped when read
  std::size_t outliers = 0;    ///< dropped by denoising
  /// Is each point the mean of those in a cube?
  bool thinned = false;
  /// Do the file's normals distinguish inside from outside?
  bool normals_agree = false;

  /// Where paths are measured, smoothed or not.
  [[nodiscard]] const std::vector<std::array<double, 3>>& measured() const {
    return smoothed.empty() ? points.positions : smoothed;
  }
  /// The file's normals where they distinguish inside from outside, else none.
  [[nodiscard]] std::span<const std::array<double, 3>> normals() const {
    return normals_agree ? std::span(points.normals) : std::span<const std::array<double, 3>>();
  }
};

/// Whether the format is one of clouds alone, as .xyz and .las. Throws as io::format_of.
[[nodiscard]] bool is_cloud_file(const std::string& file);

/// The points of a file, before anything is done to them.
struct CloudFile {
  /// As read.
  io::Points points;
  std::size_t not_finite = 0;  ///< dropped
};

/// Reads the points of `file`, a cloud or any .ply. Throws as io::read_points, and NotBuiltError
/// for a .pcd without PCL, or for any without FLANN.
[[nodiscard]] CloudFile read_cloud(const std::string& file);

/// Thins and denoises the points as the options say, looks for neighbours and smooths. `name` is
/// for messages. Throws NotBuiltError for what this build lacks, and UsageError for a voxel that is
/// too small.
[[nodiscard]] CloudShape make_cloud(const std::string& name, CloudFile read,
                                    const ReadOptions& options);

/// The numbers that points left out have in the file, ascending; nothing where the points are
/// means.
[[nodiscard]] std::optional<std::vector<Index>> dropped_points(const CloudShape& cloud);

/// The smallest number of neighbours that connects all points, if it is not above 256; nothing
/// without FLANN.
[[nodiscard]] std::optional<std::size_t> connecting_k(const CloudShape& cloud);

}  // namespace plexway
