#pragma once

#include <optional>
#include <string>

namespace CLI {
class App;
}

namespace plexway::cli {

/// What is asked of level sets, as typed.
struct VolumeOptions {
  bool repair = false;
  std::string grid;
  std::optional<double> voxel;  ///< of a cloud, too: there it thins
  bool writes_volume = false;   ///< a .vdb is written, with that voxel
};

/// Adds the options to a command, in a group of their own.
void add_volume_options(CLI::App& command, VolumeOptions& options);

/// Throws UsageError for a value out of range.
void check(const VolumeOptions& options);

/// Whether the extension is .vdb.
bool is_vdb(const std::string& file);

}  // namespace plexway::cli
