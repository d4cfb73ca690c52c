#pragma once

#include <string>

namespace CLI {
class App;
}

namespace plexway::cli {

/// What `-h` prints of a command: its usage, the options that most need and three examples, in at
/// most 25 lines of 80 columns. Of the tool itself its commands. `--help` has everything.
std::string short_help(const CLI::App& app);

}  // namespace plexway::cli
