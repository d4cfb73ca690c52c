#include "pcl_functions.hpp"

#include <plexway/error.hpp>

#ifdef PLEXWAY_PCL_MODULE
#include <dlfcn.h>
#endif

namespace plexway::cli {

#ifdef PLEXWAY_PCL_MODULE
const PclFunctions& pcl_functions(const std::string& what) {
  static const PclFunctions* const functions = [&] {
    // Found by the tool's RUNPATH. Lazily, because to look up all that PCL and VTK might call takes
    // a third of a second. It stays loaded: what it throws must outlive it.
    void* const module = ::dlopen(PLEXWAY_PCL_MODULE, RTLD_LAZY | RTLD_LOCAL);
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
