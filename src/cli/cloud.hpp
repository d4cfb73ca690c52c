#pragma once

#include <array>
#include <cstddef>
#include <filesystem>
#include <functional>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <plexway/complex/ids.hpp>
#include <plexway/complex/neighbours.hpp>
#include <plexway/complex/point_cloud.hpp>
#include <plexway/io/points.hpp>

#include "cloud_options.hpp"
#include "progress.hpp"

namespace plexway::cli {

/// Points with their neighbours. Thinned and denoised points are gone: numbers count those kept,
/// and `points.original` has those in the file.
struct Cloud {
  io::Points points;
  /// Where paths are measured, one a point; empty: at the points.
  std::vector<std::array<double, 3>> smoothed;
  Neighbours neighbours;
  std::size_t k = 0;  ///< as asked for; 0: all within a radius
  std::optional<double> max_normal_angle;

  std::size_t points_in_file = 0;
  std::size_t not_finite = 0;  ///< dropped when read
  std::size_t outliers = 0;    ///< dropped by --denoise
  bool thinned = false;
  bool normals_agree = false;
  std::function<bool(double)> progress;  ///< of what is made of it

  [[nodiscard]] const std::vector<std::array<double, 3>>& measured() const {
    return smoothed.empty() ? points.positions : smoothed;
  }
  /// The file's normals where they tell inside from outside, else none.
  [[nodiscard]] std::span<const std::array<double, 3>> normals() const {
    return normals_agree ? std::span(points.normals) : std::span<const std::array<double, 3>>();
  }
};

/// Whether the extension is one of clouds alone, .xyz and .pcd.
bool is_cloud_file(const std::string& file);

/// The points of a file, before anything is done to them.
struct CloudFile {
  io::Points points;
  std::size_t not_finite = 0;  ///< dropped
};

/// Reads the points of `file`, a cloud or any .ply. Throws as io::read_points, and NotBuiltError
/// for a .pcd without PCL, or for any without FLANN.
CloudFile read_cloud(const std::string& file);

/// Thins and denoises the points as `arguments` say, looks for neighbours and smooths. `file` is
/// for messages. Throws NotBuiltError for what this build lacks, and UsageError for a voxel that is
/// too small.
Cloud make_cloud(const std::string& file, CloudFile read, const CloudArguments& arguments,
                 ProgressLine& progress);

/// What a cloud says of how its complex is made. The options refer to it.
CloudOptions cloud_options(const Cloud& cloud);

/// The point nearest to `point`; the first of several. Cost: linear.
Index nearest_point(const Cloud& cloud, const std::array<double, 3>& point);

/// Writes one distance a point; the extension of `out` picks the format. Throws as io::write_field
/// and, for .pcd, as pcl::write_field.
void write_field(const std::filesystem::path& out, const Cloud& cloud,
                 std::span<const double> distance, std::span<const std::int32_t> label,
                 std::span<const double> error = {});

/// The extensions that the fields of clouds may have: those of io::write_field and .pcd.
std::span<const std::string_view> cloud_field_extensions();

/// The numbers that points left out have in the file, ascending; nothing where the points are
/// means.
std::optional<std::vector<Index>> dropped_points(const Cloud& cloud);

/// How the points kept came from those in the file, for people: "5120 of 20000 points: 3 not
/// finite, 17 outliers"; empty where all were kept.
std::string kept_points(const Cloud& cloud);

/// Why some points are not reached, and what would help, for people. `components` are those of the
/// complex. Cost: several times that of finding the neighbours.
std::string why_disconnected(const Cloud& cloud, std::size_t components);

/// The smallest number of neighbours that connects all points, if it is not above 256.
std::optional<std::size_t> connecting_k(const Cloud& cloud);

}  // namespace plexway::cli
