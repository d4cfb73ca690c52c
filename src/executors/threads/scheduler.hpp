#pragma once

#include <algorithm>
#include <cstddef>
#include <mutex>
#include <utility>
#include <vector>

#include <plexway/executors.hpp>
#include <plexway/solve/options.hpp>

#include "executors/threads/rank_mail.hpp"
#include "executors/threads/team.hpp"
#include "labels/workspace_state.hpp"

namespace plexway {

/// What a team does for a solve besides the propagation, which schedulers that derive from it share
/// out.
template <class Real, bool kLabels>
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
  /// Puts what other processes know of their simplices into the front: gather(piece, take) calls
  /// take(simplex, hinge, label, source) for each that a piece of ours has reached.
  template <class Front, class Gather>
  void share_labels(std::size_t pieces, Front& front, const Gather& gather) const {
    using Label = typename Front::Label;
    struct Known {
      Index simplex, hinge, source;
      Label label;
    };
    workspace_.pieces.counts().sent += share_pieces(
        team_.ranks(), pieces,
        [&](std::size_t p, Parcel& parcel) {
          gather(p, [&](Index s, std::size_t hinge, const Label& label, Index source) {
            parcel.add(Known{s, static_cast<Index>(hinge), source, label});
          });
        },
        [&](std::size_t, Unpacked mail) {
          while (!mail.empty()) {
            const Known known = mail.template take<Known>();
            front.know(known.simplex, known.hinge, known.label, known.source);
          }
        });
  }

  // Nothing waits in the front's second queue while the team works: it has room for all simplices.
  [[nodiscard]] Index* list() const { return workspace_.front.far.get(); }

  const Team& team_;
  WorkspaceState<Real>& workspace_;
  Real step_;
  double unit_;
  const PropagateOptions& options_;
};

/// How a domain is cut where the executor does not say it.
struct PieceChoice {
  std::size_t least;  ///< simplices a piece: fewer cost more than they are good for
  std::size_t count;  ///< so many pieces where they are larger: enough for a dozen threads
};

/// Of wireframes, in vertices.
inline constexpr PieceChoice wire_pieces = {4096, 64};

/// About so many simplices a piece, of so many. Of the domain alone, never of threads. What one
/// thread does in some milliseconds is a single piece.
inline std::size_t piece_size(const OpenMP& executor, std::size_t simplices,
                              const PieceChoice& choice) {
  if (executor.piece != 0) return executor.piece;
  constexpr std::size_t too_few = std::size_t{1} << 15;
  if (simplices < too_few) return simplices + 1;
  return std::max(choice.least, simplices / choice.count);
}

/// Is all of it one piece? Then one thread does what Serial does.
inline bool is_one_piece(std::size_t size, std::size_t simplices) {
  return simplices < size + size / 2;
}

}  // namespace plexway
