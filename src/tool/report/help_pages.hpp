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

}  // namespace plexway::cli
