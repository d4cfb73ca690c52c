#pragma once

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <exception>
#include <functional>
#include <mutex>
#include <thread>
#include <type_traits>
#include <utility>
#include <vector>

#include <plexway/common/blocks.hpp>
#include <plexway/executors.hpp>
#include <plexway/executors/piece_ranks.hpp>

#include "complexes/partition/deal.hpp"
#include "executors/threads/rank_mail.hpp"

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

/// Where a team's threads wait for each other: all come, the first then does what must be done
/// alone, and lets the others go. Waits without sleeping at first, as turns are short.
class Gate {
 public:
  explicit Gate(int threads) : patience_(threads <= threads_for(0) ? 2000 : 0) {}

  /// For all but the first of so many threads.
  void pass(int threads) {
    const unsigned round = round_.load(std::memory_order_relaxed);
    if (arrived_.fetch_add(1, std::memory_order_acq_rel) + 2 == threads) arrived_.notify_one();
    wait(round_, [round](unsigned now) { return now != round; });
  }

  /// For the first: until all others are here; and they may go.
  void gather(int threads) const {
    if (threads > 1) wait(arrived_, [threads](int now) { return now == threads - 1; });
  }
  void open(int threads) {
    arrived_.store(0, std::memory_order_relaxed);
    if (threads == 1) return;
    round_.fetch_add(1, std::memory_order_release);
    round_.notify_all();
  }

 private:
  template <class Value, class Done>
  void wait(const std::atomic<Value>& value, Done done) const {
    for (int i = 0; i < patience_; ++i) {
      if (done(value.load(std::memory_order_acquire))) return;
#if defined(__x86_64__) || defined(__i386__)
      __builtin_ia32_pause();
#endif
    }
    for (int i = 0; i < 32; ++i) {  // somebody may be waiting for this core
      std::this_thread::yield();
      if (done(value.load(std::memory_order_acquire))) return;
    }
    for (Value now; !done(now = value.load(std::memory_order_acquire));) value.wait(now);
  }

  int patience_;
  alignas(64) std::atomic<int> arrived_{0};
  alignas(64) std::atomic<unsigned> round_{0};
};

/// Threads that run the same function at once: OpenMP's or, with PLEXWAY_TEAM_OF_THREADS (builds
/// for ThreadSanitizer, which does not understand OpenMP's own synchronisation), std::thread's; so
/// it is in a child that was forked, too, where OpenMP's would be waited for without end.
/// Everything else is the same code.
class Team {
 public:
  /// Throws UsageError for settings that make no sense, NotBuiltError without OpenMP.
  explicit Team(const OpenMP& executor);

  /// At most so many threads.
  [[nodiscard]] int size() const { return size_; }
  /// The processes that share pieces, or null, and which pieces are ours.
  [[nodiscard]] PieceRanks* ranks() const { return ranks_; }
  [[nodiscard]] Deal deal() const { return deal_of(ranks_); }

  /// Is it so for any process? All call it.
  [[nodiscard]] bool any(bool here) const { return sum_of(ranks_, here ? 1 : 0) > 0; }
  /// Is work(i) true for any i < count of any process? All work is done.
  template <class Work>
  [[nodiscard]] bool any(std::size_t count, const Work& work) const {
    std::atomic<bool> found{false};
    each(count, [&](std::size_t i) {
      if (work(i)) found.store(true, std::memory_order_relaxed);
    });
    return any(found.load());
  }

  /// Calls work(i, n) with i = 0 to n - 1 at once, 0 on the calling thread, and throws the first
  /// exception that one of them left behind.
  template <class Work>
  void run(const Work& work) const {
    std::exception_ptr failure;
    std::mutex mutex;
    const auto guarded = [&](int i, int n) noexcept {
      try {
        work(i, n);
      } catch (...) {
        const std::scoped_lock lock(mutex);
        if (!failure) failure = std::current_exception();
      }
    };
    if (alone_ || (held_ != nullptr && Crowding::crowded())) {
      guarded(0, 1);
    } else if (held_ == nullptr) {
      run_guarded(guarded);
    } else {
      held_->gate.gather(held_->threads);
      held_->work = guarded;
      held_->gate.open(held_->threads);
      guarded(0, held_->threads);
      held_->gate.gather(held_->threads);
    }
    if (failure) std::rethrow_exception(failure);
  }

  /// Calls `body` on this thread, and for so long the others are there for `run` and what takes it;
  /// in between they sleep. OpenMP's own threads spin for milliseconds before and after each piece
  /// of work, which is another program's time. Where that has the cores there are no others.
  template <class Body>
  void hold(const Body& body) const {
    if (size_ == 1 || held_ != nullptr) {
      body();
      return;
    }
    const Back back{alone_, alone_};
    alone_ = Crowding::crowded();
    if (alone_) {
      body();
      return;
    }
    Held held(size_);
    run([&](int i, int threads) {
      if (i != 0) {
        for (;;) {
          held.gate.pass(threads);
          if (!held.work) return;
          held.work(i, threads);
        }
      }
      held.threads = threads;
      held_ = &held;
      const auto end = [&] {
        held_ = nullptr;
        held.gate.gather(threads);
        held.work = nullptr;
        held.gate.open(threads);
      };
      try {
        body();
      } catch (...) {
        end();
        throw;
      }
      end();
    });
  }

  /// Calls work(begin, end) for ranges that make up [0, count).
  template <class Work>
  void over(std::size_t count, const Work& work) const {
    constexpr std::size_t least = 4096;  // less is not worth another thread
    if (size_ == 1 || count < 2 * least) {
      work(std::size_t{0}, count);
      return;
    }
    std::atomic<std::size_t> next{0};
    // Even, so that what is done two at a time is so with any number of threads.
    const std::size_t share = std::max(least, count / (16 * static_cast<std::size_t>(size_)) * 2);
    run([&](int, int) {
      for (;;) {
        const std::size_t begin = next.fetch_add(share, std::memory_order_relaxed);
        if (begin >= count) return;
        work(begin, std::min(begin + share, count));
      }
    });
  }

  /// Calls work(i) or work(i, thread) for all i < count, by threads as they come, until one throws.
  template <class Work>
  void each(std::size_t count, const Work& work) const {
    std::atomic<std::size_t> next{0};
    run([&](int thread, int) {
      try {
        for (std::size_t i; (i = next.fetch_add(1, std::memory_order_relaxed)) < count;)
          if constexpr (std::is_invocable_v<const Work&, std::size_t>)
            work(i);
          else
            work(i, static_cast<std::size_t>(thread));
      } catch (...) {
        next.store(count, std::memory_order_relaxed);  // no more for the others
        throw;
      }
    });
  }

 private:
  struct Held {
    explicit Held(int size) : gate(size) {}
    Gate gate;
    int threads = 1;
    std::function<void(int, int)> work;
  };
  struct Back {
    bool &value, before;
    ~Back() { value = before; }
  };
  void run_guarded(const std::function<void(int, int)>& work) const;

  int size_;
  PieceRanks* ranks_;
  mutable Held* held_ = nullptr;
  mutable bool alone_ = false;  ///< held, but by one thread
};

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

}  // namespace plexway::detail
