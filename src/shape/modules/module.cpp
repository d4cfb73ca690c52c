#include "shape/modules/module.hpp"

#include <array>
#include <atomic>

#include <plexway/error.hpp>

#include "file/new_file.hpp"

namespace plexway::detail {
namespace {

// Each module has a list of its own.
constinit std::array<std::atomic<void (*)()>, 8> removers{};

[[maybe_unused]] void add_remover(void (*remover)()) {
  for (auto& place : removers) {
    void (*nobody)() = nullptr;
    if (place == remover || place.compare_exchange_strong(nobody, remover)) return;
  }
}

}  // namespace

void remove_unfinished_files() noexcept {
  file::remove_unfinished();
  for (auto& place : removers)
    if (void (*const remover)() = place; remover != nullptr) remover();
}

}  // namespace plexway::detail

#ifdef PLEXWAY_MODULE_FOLDER
#include <dlfcn.h>

#include <filesystem>
#include <system_error>
#include <vector>

namespace plexway::detail {
namespace {

namespace fs = std::filesystem;

// The folder of the program, and that of the shared library which holds this function.
std::vector<fs::path> own_folders() {
  std::vector<fs::path> folders;
  std::error_code none_such;
  const fs::path program = fs::read_symlink("/proc/self/exe", none_such);
  if (!none_such) folders.push_back(program.parent_path());
  Dl_info here{};
  if (::dladdr(reinterpret_cast<const void*>(&module_function), &here) != 0 &&
      here.dli_fname != nullptr && fs::path(here.dli_fname).is_absolute())
    folders.push_back(fs::path(here.dli_fname).parent_path());
  return folders;
}

// Lazily, because to look up all that PCL and VTK might call takes a third of a second. It stays
// loaded: what it throws must outlive it.
void* load_module(const char* file) {
  constexpr int how = RTLD_LAZY | RTLD_LOCAL;
  for (fs::path folder : own_folders()) {
    std::error_code none_such;
    if (fs::exists(folder / "plexway" / file, none_such))
      return ::dlopen((folder / "plexway" / file).c_str(), how);
    for (int up = 0; up < 3; ++up) {
      folder = folder.parent_path();
      const fs::path beside = folder / PLEXWAY_MODULE_FOLDER / file;
      if (fs::exists(beside, none_such)) return ::dlopen(beside.c_str(), how);
    }
  }
  return ::dlopen(file, how);  // where the RUNPATH says
}

}  // namespace

void* module_function(const std::string& what, const char* library, const char* file,
                      const char* function) {
  void* const module = load_module(file);
  if (module == nullptr) {
    const char* const reason = ::dlerror();
    throw Error(what + ": plexway's module for " + library +
                " cannot be loaded: " + (reason == nullptr ? "unknown reason" : reason));
  }
  void* const entry = ::dlsym(module, function);
  if (entry == nullptr) throw Error(what + ": " + file + " is not plexway's module");
  if (void* const remover = ::dlsym(module, "plexway_remove_unfinished"); remover != nullptr)
    add_remover(reinterpret_cast<void (*)()>(remover));
  return entry;
}

}  // namespace plexway::detail
#endif

namespace plexway::detail {

/// The function of a module that returns its table, which is looked up once. Without the module
/// there is no table.
#define PLEXWAY_FUNCTIONS(Functions, functions, library, file)                                  \
  const Functions& functions(const std::string& what) {                                         \
    using Entry = const Functions* (*)();                                                       \
    static const Functions* const table =                                                       \
        reinterpret_cast<Entry>(module_function(what, library, file, "plexway_" #functions))(); \
    return *table;                                                                              \
  }
#define PLEXWAY_NO_FUNCTIONS(Functions, functions, library, package)                          \
  const Functions& functions(const std::string& what) {                                       \
    throw NotBuiltError(what + ": takes " library ", which is not built in; install " package \
                               " and build again");                                           \
  }

#ifdef PLEXWAY_HDF5_MODULE
PLEXWAY_FUNCTIONS(Hdf5Functions, hdf5_functions, "HDF5", PLEXWAY_HDF5_MODULE)
#else
PLEXWAY_NO_FUNCTIONS(Hdf5Functions, hdf5_functions, "HDF5", "libhdf5-dev")
#endif
#ifdef PLEXWAY_OPENVDB_MODULE
PLEXWAY_FUNCTIONS(OpenvdbFunctions, openvdb_functions, "OpenVDB", PLEXWAY_OPENVDB_MODULE)
#else
PLEXWAY_NO_FUNCTIONS(OpenvdbFunctions, openvdb_functions, "OpenVDB", "libopenvdb-dev")
#endif
#ifdef PLEXWAY_PCL_MODULE
PLEXWAY_FUNCTIONS(PclFunctions, pcl_functions, "PCL", PLEXWAY_PCL_MODULE)
#else
PLEXWAY_NO_FUNCTIONS(PclFunctions, pcl_functions, "PCL", "libpcl-dev")
#endif

}  // namespace plexway::detail
