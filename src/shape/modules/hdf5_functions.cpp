#include "shape/modules/hdf5_functions.hpp"

#include <plexway/error.hpp>

#include "shape/modules/module.hpp"

namespace plexway {

#ifdef PLEXWAY_HDF5_MODULE
const Hdf5Functions& hdf5_functions(const std::string& what) {
  static const Hdf5Functions* const functions = [&] {
    using Entry = const Hdf5Functions* (*)();
    return reinterpret_cast<Entry>(
        module_function(what, "HDF5", PLEXWAY_HDF5_MODULE, "plexway_hdf5_functions"))();
  }();
  return *functions;
}
#else
const Hdf5Functions& hdf5_functions(const std::string& what) {
  throw NotBuiltError(what +
                      ": takes HDF5, which is not built in; install libhdf5-dev and build again");
}
#endif

}  // namespace plexway
