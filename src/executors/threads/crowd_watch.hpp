#pragma once

#include <cstddef>
#include <utility>
#include <vector>

#include "executors/threads/crowding.hpp"

namespace plexway {

/// Tells Crowding what a team does, turn by turn.
class CrowdWatch {
 public:
  explicit CrowdWatch(int threads) : worked_(static_cast<std::size_t>(threads)) {}

  /// Thread i does its part of a turn.
  template <class Work>
  void watch(int i, const Work& work) {
    const double before = seconds_of_thread();
    work();
    worked_[static_cast<std::size_t>(i)].seconds += seconds_of_thread() - before;
  }
  /// All are through, `passed` seconds after the turn began.
  void end_turn(double passed) {
    passed_ += passed;
    constexpr double enough = 1.5e-3;
    if (!(passed_ > enough)) return;
    double sum = 0;
    for (Worked& w : worked_) sum += std::exchange(w.seconds, 0);
    Crowding::report(sum, passed_);
    passed_ = 0;
  }

 private:
  struct alignas(64) Worked {
    double seconds = 0;
  };
  std::vector<Worked> worked_;
  double passed_ = 0;
};

}  // namespace plexway
