#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>

#include "executors/threads/piece_post.hpp"
#include "executors/threads/scheduler.hpp"
#include "executors/threads/supersteps.hpp"
#include "executors/threads/team.hpp"

namespace plexway {

/// A superstep's pace by windows, in roots of the number of triangles: mean edges. A third of what
/// labels take: windows that come late do not merge with those that were there.
inline constexpr double window_pace = 1. / 48;

/// A team solves by windows, in pieces.
template <class Real>
class WindowScheduler : public TeamScheduler<Real, false> {
 public:
  using Base = TeamScheduler<Real, false>;
  WindowScheduler(const Base& base, std::size_t size) : Base(base), size_(size) {}

  [[nodiscard]] std::size_t piece_size() const { return size_; }

  /// As Supersteps::run, and adds to `statistics` what pieces did.
  template <class Piece, class GoesOn>
  bool run(const Cut& cut, std::span<Piece* const> pieces, std::size_t triangles,
           PropagateStatistics& statistics, const GoesOn& goes_on) const {
    Supersteps<Piece> supersteps(this->team_, cut, pieces,
                                 window_pace * std::sqrt(static_cast<double>(size_)), triangles,
                                 this->unit_, this->options_, this->workspace_.pieces.counts());
    const bool complete = supersteps.run({.expansions = statistics.expansions}, goes_on);
    const PropagateStatistics now = supersteps.statistics();
    statistics.expansions = now.expansions;
    statistics.updates = now.updates;
    return complete;
  }
  [[nodiscard]] Deal deal() const { return this->team_.deal(); }
  /// write(piece, parcel) for each piece of ours, read(piece, what was written) for all others.
  template <class Write, class Read>
  void share(std::size_t pieces, const Write& write, const Read& read) const {
    if (this->team_.ranks() == nullptr) return;
    const SharedPieces shared(*this->team_.ranks(), deal(), pieces, write);
    this->workspace_.pieces.counts().sent += shared.sent();
    for (std::size_t p = 0; p < pieces; ++p)
      if (!deal().is_ours(p)) read(p, shared.of(p));
  }
  /// Is it so for any process?
  [[nodiscard]] bool any(bool here) const {
    std::uint64_t sum[] = {here ? 1u : 0u};
    add_up(this->team_.ranks(), sum);
    return sum[0] > 0;
  }
  template <class Work>
  void each(std::size_t count, const Work& work) const {
    this->team_.each(count, work);
  }

 private:
  std::size_t size_;
};

}  // namespace plexway
