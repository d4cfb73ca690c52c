#pragma once

#include <atomic>
#include <cstddef>
#include <type_traits>

#include <plexway/executors.hpp>

#include "executors/threads/team.hpp"
#include "strings/labels.hpp"

namespace plexway::detail {

/// Calls solve(threads) in a domain of so many vertices, with those of the executor. What takes
/// some ten microseconds is not shared: who does it does not change the bits.
template <class E, class Solve>
void share_strings(const E& executor, std::size_t vertices, const Solve& solve) {
  if constexpr (std::is_same_v<E, OpenMP>) {
    const Team team(executor);
    constexpr std::size_t few = 1024;  // whose fronts are small
    if (vertices < few || team.size() == 1) {
      solve(strings::Threads{});
      return;
    }
    CrowdWatch watch(team.size());
    double each = 0;  // seconds, as it was last
    const auto share = [&](std::size_t count, const strings::Threads::Work& work) {
      constexpr double least = 4e-5;
      std::atomic<std::size_t> next{0};
      std::size_t done = 0;  // by the calling thread
      const double start = seconds_on_wall();
      const auto take = [&](int thread) {
        for (std::size_t i = 0; (i = next.fetch_add(1, std::memory_order_relaxed)) < count;) {
          work(i, static_cast<std::size_t>(thread));
          if (thread == 0) ++done;
        }
        if (thread == 0 && done > 0) each = (seconds_on_wall() - start) / static_cast<double>(done);
      };
      if (static_cast<double>(count) * each < least) {
        take(0);
        return;
      }
      team.run([&](int thread, int) { watch.watch(thread, [&] { take(thread); }); });
      watch.end_turn(seconds_on_wall() - start);
    };
    team.hold([&] { solve(strings::Threads{static_cast<std::size_t>(team.size()), share}); });
  } else {
    solve(strings::Threads{});
  }
}

}  // namespace plexway::detail
