#include "tool_module.hpp"

#ifdef PLEXWAY_MODULE_FOLDER
#include <dlfcn.h>

#include <filesystem>
#include <system_error>

#include <plexway/error.hpp>

namespace plexway::cli {
namespace {

// Lazily, because to look up all that PCL and VTK might call takes a third of a second. It stays
// loaded: what it throws must outlive it.
void* load_module(const char* file) {
  constexpr int how = RTLD_LAZY | RTLD_LOCAL;
  std::error_code none_such;
  const auto tool = std::filesystem::read_symlink("/proc/self/exe", none_such);
  const auto beside = tool.parent_path() / PLEXWAY_MODULE_FOLDER / file;
  if (!none_such && std::filesystem::exists(beside, none_such))
    return ::dlopen(beside.c_str(), how);
  return ::dlopen(file, how);  // where the tool's RUNPATH says
}

}  // namespace

void* tool_module_function(const std::string& what, const char* library, const char* file,
                           const char* function) {
  void* const module = load_module(file);
  if (module == nullptr) {
    const char* const reason = ::dlerror();
    throw Error(what + ": the tool's module for " + library +
                " cannot be loaded: " + (reason == nullptr ? "unknown reason" : reason));
  }
  void* const entry = ::dlsym(module, function);
  if (entry == nullptr) throw Error(what + ": " + file + " is not the tool's module");
  return entry;
}

}  // namespace plexway::cli
#endif
