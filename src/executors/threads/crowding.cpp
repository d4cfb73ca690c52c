#include "executors/threads/crowding.hpp"

#include <algorithm>
#include <atomic>
#include <chrono>

#if __has_include(<unistd.h>)
#include <time.h>
#include <unistd.h>
#endif

namespace plexway::detail {
namespace {

constexpr double shortest = 8e-3, longest = 0.5;
std::atomic<double> alone_until{0}, period{shortest};

}  // namespace

bool Crowding::crowded() noexcept {
  return seconds_on_wall() < alone_until.load(std::memory_order_relaxed);
}

void Crowding::report(double worked, double passed) noexcept {
  if (worked > 1.15 * passed) {
    period.store(shortest, std::memory_order_relaxed);
  } else if (worked < passed) {
    const double now = period.load(std::memory_order_relaxed);
    alone_until.store(seconds_on_wall() + now, std::memory_order_relaxed);
    period.store(std::min(2 * now, longest), std::memory_order_relaxed);
  }
}

double seconds_on_wall() noexcept {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

double seconds_of_thread() noexcept {
#if defined(_POSIX_THREAD_CPUTIME) && _POSIX_THREAD_CPUTIME >= 0
  timespec t{};
  if (::clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t) == 0)
    return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
#endif
  return seconds_on_wall();
}

}  // namespace plexway::detail
