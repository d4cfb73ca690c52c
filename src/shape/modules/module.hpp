#pragma once

#include <string>

namespace plexway {

/// Loads a module and looks up its function. Some providers' libraries take longer to load than all
/// that is done with most files, so they are behind modules that are loaded when they are needed.
/// They lie in LIBDIR/plexway beside the program or the library that has this code, or where the
/// program's RUNPATH says.
///
/// `what` starts the message, `library` is what the module is for. Throws Error where the module
/// was not installed.
void* module_function(const std::string& what, const char* library, const char* file,
                      const char* function);

/// Removes the temporary files of this program and of the modules it has loaded. May be called by a
/// handler of signals.
void remove_unfinished_files() noexcept;

}  // namespace plexway
