#include "executors/team.hpp"

#include <string>

#include <plexway/error.hpp>

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

}  // namespace plexway
