#include "file/unfinished.hpp"

#include <unistd.h>

#include <array>
#include <atomic>
#include <csignal>
#include <cstdlib>
#include <cstring>

namespace plexway::file {
namespace {

// Who takes a name out of its place owns it. Never destroyed: a handler may come at any time.
constinit std::array<std::atomic<char*>, 64> names{};
static_assert(std::atomic<char*>::is_always_lock_free);

}  // namespace

Unfinished::Unfinished(const char* path) : place_(names.size()) {
  char* const name = ::strdup(path);
  if (name == nullptr) return;
  for (place_ = 0; place_ < names.size(); ++place_) {
    char* nobody = nullptr;
    if (names[place_].compare_exchange_strong(nobody, name)) return;
  }
  std::free(name);
}

Unfinished::~Unfinished() {
  if (place_ < names.size()) std::free(names[place_].exchange(nullptr));
}

void remove_unfinished() noexcept {
  for (auto& place : names)
    if (char* const name = place.exchange(nullptr); name != nullptr) ::unlink(name);
}

SignalsHeld::SignalsHeld() {
  static_assert(sizeof(sigset_t) <= sizeof before_);
  sigset_t ending, before;
  ::sigemptyset(&ending);
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) ::sigaddset(&ending, signal);
  ::pthread_sigmask(SIG_BLOCK, &ending, &before);
  std::memcpy(before_, &before, sizeof before);
}

SignalsHeld::~SignalsHeld() {
  sigset_t before;
  std::memcpy(&before, before_, sizeof before);
  ::pthread_sigmask(SIG_SETMASK, &before, nullptr);
}

}  // namespace plexway::file
