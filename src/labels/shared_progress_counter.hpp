#pragma once

#include <atomic>
#include <cstddef>
#include <thread>

#include <plexway/solve/options.hpp>

#include "labels/progress_counter.hpp"

namespace plexway {

/// A ProgressCounter for work that several threads share. The caller is told on its own thread,
/// which makes this; the others only hear that it wants to stop.
class SharedProgressCounter {
 public:
  SharedProgressCounter(const PropagateOptions& options, std::size_t often)
      : counter_(options, often) {}

  /// So much more is done by this thread. False if it is to end: the caller's own thread throws.
  template <class Now>
  [[nodiscard]] bool count(std::size_t more, const Now& progress) {
    if (std::this_thread::get_id() != callers_) return !stop_.load(std::memory_order_relaxed);
    done_ += more;
    try {
      counter_.count(done_, progress);
    } catch (...) {
      stop_ = true;
      throw;
    }
    return true;
  }

 private:
  ProgressCounter counter_;
  std::thread::id callers_ = std::this_thread::get_id();
  std::size_t done_ = 0;  // by the caller's thread
  std::atomic<bool> stop_{false};
};

}  // namespace plexway
