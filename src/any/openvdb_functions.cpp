#include "openvdb_functions.hpp"

#include <plexway/error.hpp>

#include "tool_module.hpp"

namespace plexway::cli {

#ifdef PLEXWAY_OPENVDB_MODULE
const OpenvdbFunctions& openvdb_functions(const std::string& what) {
  static const OpenvdbFunctions* const functions = [&] {
    using Entry = const OpenvdbFunctions* (*)();
    return reinterpret_cast<Entry>(tool_module_function(what, "OpenVDB", PLEXWAY_OPENVDB_MODULE,
                                                        "plexway_openvdb_functions"))();
  }();
  return *functions;
}
#else
const OpenvdbFunctions& openvdb_functions(const std::string& what) {
  throw NotBuiltError(
      what + ": takes OpenVDB, which is not built in; install libopenvdb-dev and build again");
}
#endif

}  // namespace plexway::cli
