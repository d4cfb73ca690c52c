#include "executors/team.hpp"

#include <string>

#include <plexway/error.hpp>

#include "executors/share_out.hpp"

namespace plexway {

bool openmp_built() {
#if defined(PLEXWAY_CORE_OPENMP) || defined(PLEXWAY_TEAM_OF_THREADS)
  return true;
#else
  return false;
#endif
}

Team::Team(const OpenMP& executor) : size_(executor.threads), chunk_(executor.chunk) {
  if (!openmp_built())
    throw NotBuiltError(
        "the executor OpenMP is not built in: rebuild plexway with a compiler that has OpenMP");
  constexpr int most = 1024;
  if (executor.threads < 0 || executor.threads > most)
    throw UsageError("the number of threads must be from 0 (all) to " + std::to_string(most));
  if (executor.chunk == 0) throw UsageError("the chunk must be >= 1");
  if (size_ > 0) return;
#if defined(PLEXWAY_TEAM_OF_THREADS)
  size_ = static_cast<int>(std::max(std::thread::hardware_concurrency(), 1u));
#elif defined(PLEXWAY_CORE_OPENMP)
  size_ = std::min(omp_get_max_threads(), most);
#endif
}

std::size_t team_size(const OpenMP& executor) {
  return static_cast<std::size_t>(Team(executor).size());
}

namespace detail {

void share_out(const OpenMP& executor, std::size_t count,
               const std::function<void(std::size_t, std::size_t)>& work) {
  const Team team(executor);
  std::atomic<std::size_t> next{0};
  team.run([&](int thread, int) {
    for (;;) {
      const std::size_t k = next.fetch_add(1, std::memory_order_relaxed);
      if (k >= count) return;
      try {
        work(k, static_cast<std::size_t>(thread));
      } catch (...) {
        next.store(count, std::memory_order_relaxed);  // no more for the others
        throw;
      }
    }
  });
}

}  // namespace detail

}  // namespace plexway
