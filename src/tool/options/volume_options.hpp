#pragma once

#include <plexway/shape/read_options.hpp>

namespace CLI {
class App;
}

namespace plexway::cli {

/// Adds the options to a command, in a group of their own.
void add_volume_options(CLI::App& command, VolumeOptions& options);

}  // namespace plexway::cli
