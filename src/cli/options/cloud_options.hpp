#pragma once

#include <cstddef>
#include <limits>
#include <optional>
#include <string>

namespace CLI {
class App;
}

namespace plexway::cli {

/// How to make a complex of points, as typed.
struct CloudArguments {
  std::optional<std::size_t> k;
  std::optional<double> neighbour_radius;
  std::optional<double> max_normal_angle;
  std::optional<double> voxel;  ///< typed as one of VolumeOptions
  bool denoise = false;
  std::optional<double> deviations;
  bool smooth = false;

  /// Whether any of them was.
  [[nodiscard]] bool given() const;
};

/// Adds the options to a command, in a group of their own.
void add_cloud_options(CLI::App& command, CloudArguments& options);

/// Throws UsageError for a value out of range.
void check(const CloudArguments& options);

}  // namespace plexway::cli
