#pragma once

#include <string>

namespace plexway::cli {

/// Loads one of the tool's modules and looks up its function: what it takes is behind them, so that
/// the tool starts without other people's large libraries. `what` starts the message, `library` is
/// what the module is for. Throws Error where the module was not installed beside the tool.
void* tool_module_function(const std::string& what, const char* library, const char* file,
                           const char* function);

/// Removes the temporary files of this program and of the modules it has loaded. May be called by a
/// handler of signals.
void remove_unfinished_files() noexcept;

}  // namespace plexway::cli
