#pragma once

#include <string>
#include <string_view>

namespace CLI {
class App;
}

namespace plexway::cli {

/// A manual page ("man") or completions for a shell ("bash", "zsh", "fish"), made from the options
/// that the tool has. Throws UsageError for another kind.
std::string help_page(const CLI::App& tool, std::string_view kind);

/// What `-h` prints of a command: its usage, the options that most need and three examples, in at
/// most 25 lines of 80 columns. Of the tool itself its commands. `--help` has everything.
std::string short_help(const CLI::App& app);

}  // namespace plexway::cli
