#include "pcl_functions.hpp"

#include <plexway/error.hpp>

#ifdef PLEXWAY_PCL_MODULE
#include <dlfcn.h>

#include <system_error>
#endif

namespace plexway::cli {

#ifdef PLEXWAY_PCL_MODULE
namespace {

// Lazily, because to look up all that PCL and VTK might call takes a third of a second. It stays
// loaded: what it throws must outlive it.
void* load_module() {
  constexpr int how = RTLD_LAZY | RTLD_LOCAL;
  std::error_code none_such;
  const auto tool = std::filesystem::read_symlink("/proc/self/exe", none_such);
  const auto beside = tool.parent_path() / PLEXWAY_PCL_FOLDER / PLEXWAY_PCL_MODULE;
  if (!none_such && std::filesystem::exists(beside, none_such))
    return ::dlopen(beside.c_str(), how);
  return ::dlopen(PLEXWAY_PCL_MODULE, how);  // where the tool's RUNPATH says
}

}  // namespace

const PclFunctions& pcl_functions(const std::string& what) {
  static const PclFunctions* const functions = [&] {
    void* const module = load_module();
    if (module == nullptr) {
      const char* const reason = ::dlerror();
      throw Error(what + ": the tool's module for PCL cannot be loaded: " +
                  (reason == nullptr ? "unknown reason" : reason));
    }
    using Entry = const PclFunctions* (*)();
    const auto entry = reinterpret_cast<Entry>(::dlsym(module, "plexway_pcl_functions"));
    if (entry == nullptr) throw Error(what + ": " PLEXWAY_PCL_MODULE " is not the tool's module");
    return entry();
  }();
  return *functions;
}
#else
const PclFunctions& pcl_functions(const std::string& what) {
  throw NotBuiltError(what +
                      ": takes PCL, which is not built in; install libpcl-dev and build again");
}
#endif

}  // namespace plexway::cli
