#pragma once

#include <atomic>
#include <cstddef>
#include <functional>
#include <memory>
#include <vector>

#include <plexway/executors.hpp>
#include <plexway/solve/options.hpp>

namespace plexway::detail {

/// Calls work(k, thread) for all k < count, thread by thread as they come, until one throws.
/// Throws what the first of them threw. `threads` is at most the team's size.
void share_out(const OpenMP& executor, std::size_t count,
               const std::function<void(std::size_t k, std::size_t thread)>& work);

/// What each thread's own solves report to: the caller's function, called on the caller's thread,
/// which is the first; all of them hear by `stop` that it asked to stop, or that another failed.
[[nodiscard]] inline std::function<bool(const Progress&)> shared_progress(
    const std::function<bool(const Progress&)>& callers, std::size_t thread,
    std::atomic<bool>& stop) {
  return [&callers, thread, &stop](const Progress& progress) {
    if (thread == 0 && callers && !callers(progress)) stop = true;
    return !stop;
  };
}

/// One solve for each k < count, with what its thread owns: solve_one(k, own, thread). An `Own` has
/// options, which become these, with a progress of the thread's.
template <class Own, class SolveOne>
void share_out_solves(const OpenMP& executor, std::size_t count, const PropagateOptions& options,
                      const SolveOne& solve_one) {
  std::vector<std::unique_ptr<Own>> own(team_size(executor));
  std::atomic<bool> stop{false};
  share_out(executor, count, [&](std::size_t k, std::size_t thread) {
    std::unique_ptr<Own>& mine = own[thread];
    if (!mine) {
      mine = std::make_unique<Own>();
      mine->options = options;
      if (options.progress)
        mine->options.progress = shared_progress(options.progress, thread, stop);
    }
    solve_one(k, *mine, thread);
  });
}

}  // namespace plexway::detail
