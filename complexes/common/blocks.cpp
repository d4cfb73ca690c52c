#include <plexway/common/blocks.hpp>

#include <algorithm>
#include <atomic>
#include <exception>
#include <mutex>
#include <thread>
#include <vector>

#include <plexway/error.hpp>

namespace plexway {

int threads_for(int asked) {
  // Once a process: the system reads it from files, which is ten times a small domain's work.
  static const int all = static_cast<int>(std::max(std::thread::hardware_concurrency(), 1u));
  return asked > 0 ? asked : all;
}

void for_blocks(std::size_t count, std::size_t block, int threads,
                const std::function<bool(double)>& progress,
                const std::function<void(std::size_t, std::size_t)>& work) {
  std::atomic<std::size_t> next = 0, done = 0;
  std::atomic<bool> stop = false;
  std::exception_ptr error;
  std::size_t failed = 0;  // where, once there is one
  std::mutex error_mutex;
  const auto keep_error = [&](std::size_t at) {
    const std::lock_guard lock(error_mutex);
    if (!error || at < failed) error = std::current_exception(), failed = at;
    stop = true;
  };
  const auto work_on = [&](bool callers) noexcept {
    std::size_t first = count;
    try {
      while (!stop) {
        // A block that was taken is worked on: those before the first that fails are done.
        first = next.fetch_add(block);
        if (first >= count) return;
        const std::size_t last = std::min(first + block, count);
        work(first, last);
        done += last - first;
        first = count;
        if (callers && progress &&
            !progress(static_cast<double>(done) / static_cast<double>(count)))
          throw Cancelled("stopped by the progress callback");
      }
    } catch (...) {
      keep_error(first);
    }
  };
  const std::size_t blocks = count / block + (count % block != 0);
  const std::size_t most = blocks > 1 ? static_cast<std::size_t>(threads_for(threads)) : 1;
  std::vector<std::thread> helpers;
  for (std::size_t i = 1; i < std::min(most, blocks); ++i) {
    try {
      helpers.emplace_back(work_on, false);
    } catch (const std::system_error&) {
      break;  // no thread to be had: those there are do the work
    }
  }
  work_on(true);
  for (std::thread& helper : helpers) helper.join();
  if (error) std::rethrow_exception(error);
  if (progress && !progress(1)) throw Cancelled("stopped by the progress callback");
}

}  // namespace plexway
