#include "tool_module.hpp"

#include <array>
#include <atomic>

#include "file/unfinished.hpp"

namespace plexway::cli {
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

}  // namespace plexway::cli

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
  if (void* const remover = ::dlsym(module, "plexway_remove_unfinished"); remover != nullptr)
    add_remover(reinterpret_cast<void (*)()>(remover));
  return entry;
}

}  // namespace plexway::cli
#endif
