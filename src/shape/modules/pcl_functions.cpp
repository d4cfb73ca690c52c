#include "shape/modules/pcl_functions.hpp"

#include <plexway/error.hpp>

#include "shape/modules/module.hpp"

namespace plexway {

#ifdef PLEXWAY_PCL_MODULE
const PclFunctions& pcl_functions(const std::string& what) {
  static const PclFunctions* const functions = [&] {
    using Entry = const PclFunctions* (*)();
    return reinterpret_cast<Entry>(
        module_function(what, "PCL", PLEXWAY_PCL_MODULE, "plexway_pcl_functions"))();
  }();
  return *functions;
}
#else
const PclFunctions& pcl_functions(const std::string& what) {
  throw NotBuiltError(what +
                      ": takes PCL, which is not built in; install libpcl-dev and build again");
}
#endif

}  // namespace plexway
