#pragma once

#include <ctime>

namespace bench {

/// Seconds of the processor that `work` takes, of all threads: what else runs does not count.
template <class Work>
double processor_seconds(const Work& work) {
  const std::clock_t start = std::clock();
  work();
  return static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
}

}  // namespace bench
