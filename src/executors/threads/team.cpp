#include "executors/threads/team.hpp"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <string>
#include <system_error>
#include <vector>

#include <plexway/error.hpp>

#include "executors/threads/share_out.hpp"

#if __has_include(<unistd.h>)
#include <time.h>
#include <unistd.h>
#endif

#if defined(PLEXWAY_CORE_OPENMP) && !defined(PLEXWAY_TEAM_OF_THREADS)
#include <omp.h>
#if __has_include(<pthread.h>)
#include <pthread.h>
#define PLEXWAY_FORKS 1
#endif
#endif

namespace plexway {
using namespace detail;

bool openmp_built() {
#if defined(PLEXWAY_CORE_OPENMP) || defined(PLEXWAY_TEAM_OF_THREADS)
  return true;
#else
  return false;
#endif
}

std::size_t team_size(const OpenMP& executor) {
  return static_cast<std::size_t>(Team(executor).size());
}

namespace detail {
namespace {

constexpr double shortest = 8e-3, longest = 0.5;
std::atomic<double> alone_until{0}, period{shortest};

#if defined(PLEXWAY_FORKS)
// A child has none of its parent's threads, and GNU's OpenMP does not know.
std::atomic<bool> forked{false};
[[maybe_unused]] const int watched =
    ::pthread_atfork(nullptr, nullptr, [] { forked.store(true, std::memory_order_relaxed); });
#endif

#if defined(PLEXWAY_FORKS) || defined(PLEXWAY_TEAM_OF_THREADS)
// By threads of their own. Who comes first waits until it is known how many the system gave.
void run_threads(int size, const std::function<void(int, int)>& work) {
  std::atomic<int> all{0};
  std::vector<std::thread> threads;
  threads.reserve(static_cast<std::size_t>(size));
  try {
    for (int i = 1; i < size; ++i)
      threads.emplace_back([&, i] {
        all.wait(0);
        work(i, all.load());
      });
  } catch (const std::system_error&) {  // then with fewer
  }
  const int count = static_cast<int>(threads.size()) + 1;
  all.store(count);
  all.notify_all();
  work(0, count);
  for (std::thread& thread : threads) thread.join();
}
#endif

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

Team::Team(const OpenMP& executor) : size_(executor.threads), ranks_(executor.ranks) {
  if (!openmp_built())
    throw NotBuiltError(
        "the executor OpenMP is not built in: rebuild plexway with a compiler that has OpenMP");
  constexpr int most = 1024;
  if (executor.threads < 0 || executor.threads > most)
    throw UsageError("the number of threads must be from 0 (all) to " + std::to_string(most));
  if (size_ > 0) return;
#if defined(PLEXWAY_TEAM_OF_THREADS)
  size_ = threads_for(0);
#elif defined(PLEXWAY_CORE_OPENMP)
  size_ = std::min(omp_get_max_threads(), most);
#endif
}

void Team::run_guarded(const std::function<void(int, int)>& work) const {
  if (size_ == 1) {
    work(0, 1);
    return;
  }
#if defined(PLEXWAY_TEAM_OF_THREADS)
  run_threads(size_, work);
#elif defined(PLEXWAY_CORE_OPENMP)
#if defined(PLEXWAY_FORKS)
  if (forked.load(std::memory_order_relaxed)) {
    run_threads(size_, work);
    return;
  }
#endif
#pragma omp parallel num_threads(size_)
  work(omp_get_thread_num(), omp_get_num_threads());
#endif
}

void share_out(const OpenMP& executor, std::size_t count,
               const std::function<void(std::size_t, std::size_t)>& work) {
  Team(executor).each(count, work);
}

}  // namespace detail

}  // namespace plexway
