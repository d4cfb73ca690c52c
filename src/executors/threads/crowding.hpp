#pragma once

#include <cstddef>
#include <utility>
#include <vector>

namespace plexway::detail {

/// Another program on our cores makes threads that wait for each other wait for it: one thread is
/// faster than two then. How many threads' worth of work a team does is what its threads worked, by
/// their own clocks, over the time that passed. Kept for the process, since the next solve finds
/// the same cores. Who works changes no result.
class Crowding {
 public:
  /// Should one thread work alone for now? For a few milliseconds after a team did no more than one
  /// thread does, twice as long each time, up to half a second; then a team may try again.
  [[nodiscard]] static bool crowded() noexcept;

  /// What a team did, in seconds; some milliseconds are enough.
  static void report(double worked, double passed) noexcept;
};

/// What the calling thread has worked, in seconds.
[[nodiscard]] double seconds_of_thread() noexcept;
/// Those of a clock that never goes back.
[[nodiscard]] double seconds_on_wall() noexcept;

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

}  // namespace plexway::detail
