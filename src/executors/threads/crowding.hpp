#pragma once

namespace plexway {

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

}  // namespace plexway
