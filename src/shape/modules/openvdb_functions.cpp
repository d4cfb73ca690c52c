#include "shape/modules/openvdb_functions.hpp"

#include <plexway/error.hpp>

#include "shape/modules/module.hpp"

namespace plexway {

#ifdef PLEXWAY_OPENVDB_MODULE
const OpenvdbFunctions& openvdb_functions(const std::string& what) {
  static const OpenvdbFunctions* const functions = [&] {
    using Entry = const OpenvdbFunctions* (*)();
    return reinterpret_cast<Entry>(
        module_function(what, "OpenVDB", PLEXWAY_OPENVDB_MODULE, "plexway_openvdb_functions"))();
  }();
  return *functions;
}
#else
const OpenvdbFunctions& openvdb_functions(const std::string& what) {
  throw NotBuiltError(
      what + ": takes OpenVDB, which is not built in; install libopenvdb-dev and build again");
}
#endif

}  // namespace plexway
