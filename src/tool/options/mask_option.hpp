#pragma once

#include "shape/arguments/mask_argument.hpp"

namespace CLI {
class App;
}

namespace plexway::cli {

/// Adds --mask to a command.
void add_mask_option(CLI::App& command, MaskArgument& argument);

}  // namespace plexway::cli
