#pragma once

#include <algorithm>
#include <cstddef>
#include <mutex>
#include <utility>
#include <vector>

#include <plexway/executors.hpp>
#include <plexway/solve/options.hpp>

#include "executors/threads/team.hpp"
#include "labels/workspace_state.hpp"

namespace plexway::detail {

/// What a team does for a solve besides the propagation, which schedulers that derive from it share
/// out.
template <class Real>
class TeamScheduler {
 public:
  TeamScheduler(const Team& team, WorkspaceState<Real>& workspace, Real step, double unit,
                const PropagateOptions& options)
      : team_(team), workspace_(workspace), step_(step), unit_(unit), options_(options) {}

  template <class Work>
  void over(std::size_t count, const Work& work) const {
    team_.over(count, work);
  }

  /// In order, and those that are wanted before any is looked at: with any number of threads.
  template <class Wanted, class Look>
  void search(std::size_t count, const Wanted& wanted, const Look& look) const {
    // Where a range begins, those found in it are written: nothing is shared, nothing to sort.
    Index* const found = list();
    std::vector<std::pair<std::size_t, std::size_t>> ranges;
    std::mutex mutex;
    team_.over(count, [&](std::size_t begin, std::size_t end) {
      std::size_t last = begin;
      for (std::size_t i = begin; i < end; ++i)
        if (wanted(i)) found[last++] = static_cast<Index>(i);
      const std::scoped_lock lock(mutex);
      ranges.emplace_back(begin, last);
    });
    std::sort(ranges.begin(), ranges.end());
    for (const auto& [begin, end] : ranges)
      for (std::size_t i = begin; i < end; ++i) look(found[i]);
  }

  [[nodiscard]] const Team& team() const { return team_; }

 protected:
  // Nothing waits in the front's second queue while the team works: it has room for all simplices.
  [[nodiscard]] Index* list() const { return workspace_.front.far.get(); }

  const Team& team_;
  WorkspaceState<Real>& workspace_;
  Real step_;
  double unit_;
  const PropagateOptions& options_;
};

/// About so many simplices a piece, of so many. Of the domain alone, never of threads. What one
/// thread does in some milliseconds is a single piece; fewer than 4096 cost more than they are good
/// for, and 64 pieces are enough for a dozen threads.
inline std::size_t piece_size(const OpenMP& executor, std::size_t simplices) {
  if (executor.piece != 0) return executor.piece;
  constexpr std::size_t too_few = std::size_t{1} << 15, least = 4096, pieces = 64;
  return simplices < too_few ? simplices + 1 : std::max(least, simplices / pieces);
}

/// Is all of it one piece? Then one thread does what Serial does.
inline bool is_one_piece(std::size_t size, std::size_t simplices) {
  return simplices < size + size / 2;
}

}  // namespace plexway::detail
