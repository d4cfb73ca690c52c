#pragma once

#include <atomic>
#include <cstddef>
#include <vector>

namespace plexway {

/// Work that comes in turns and belongs to threads, whose caches have what it needs: a thread does
/// its own and then takes what others have not come to, from the end. Who does what must change
/// nothing.
class OwnedWork {
 public:
  /// At most so much in a turn.
  explicit OwnedWork(std::size_t most) : taken_(most) {}

  /// One thread's share of work(i) for all i < count, all done when all threads have called it.
  /// `owner` gives a number for i: thread owner(i) % threads has it. `turn` is another one each
  /// time, never 0.
  template <class Owner, class Work>
  void share(std::size_t turn, int thread, int threads, std::size_t count, const Owner& owner,
             const Work& work) {
    const auto take = [&](std::size_t i) {
      std::atomic<std::size_t>& taken = taken_[i];
      if (taken.load(std::memory_order_relaxed) != turn &&
          taken.exchange(turn, std::memory_order_relaxed) != turn)
        work(i);
    };
    const auto all = static_cast<std::size_t>(threads), own = static_cast<std::size_t>(thread);
    for (std::size_t i = 0; i < count; ++i)
      if (owner(i) % all == own) take(i);
    if (threads > 1)
      for (std::size_t i = count; i-- > 0;) take(i);
  }

 private:
  std::vector<std::atomic<std::size_t>> taken_;  // in which turn last
};

}  // namespace plexway
