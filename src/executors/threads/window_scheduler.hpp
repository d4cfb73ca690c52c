#pragma once

#include <cmath>
#include <cstddef>
#include <span>

#include <plexway/executors.hpp>
#include <plexway/solve/accuracy.hpp>
#include <plexway/solve/distance_field.hpp>
#include <plexway/solve/options.hpp>
#include <plexway/source/point_source.hpp>
#include <plexway/surface/triangle_mesh.hpp>

#include "executors/threads/rank_mail.hpp"
#include "executors/threads/scheduler.hpp"
#include "executors/threads/supersteps.hpp"
#include "executors/threads/team.hpp"
#include "labels/workspace_state.hpp"

namespace plexway::detail {

/// A superstep's pace by windows, in roots of the number of triangles: mean edges. A third of what
/// labels take: windows that come late do not merge with those that were there.
inline constexpr double window_pace = 1. / 48;

/// A team solves by windows, in pieces.
template <class Real>
class WindowScheduler : public TeamScheduler<Real> {
 public:
  using Base = TeamScheduler<Real>;
  WindowScheduler(const Base& base, std::size_t size) : Base(base), size_(size) {}

  [[nodiscard]] std::size_t piece_size() const { return size_; }

  /// As Supersteps::run, and adds to `statistics` what pieces did.
  template <class Piece, class GoesOn>
  bool run(const Cut& cut, OurPieces<Piece>& pieces, std::size_t triangles,
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
  /// As share_pieces.
  template <class Write, class Read>
  void share(std::size_t pieces, const Write& write, const Read& read) const {
    this->workspace_.pieces.counts().sent += share_pieces(this->team_.ranks(), pieces, write, read);
  }
  /// As Team::any and Team::each.
  template <class Work>
  [[nodiscard]] bool any(std::size_t count, const Work& work) const {
    return this->team_.any(count, work);
  }
  template <class Work>
  void each(std::size_t count, const Work& work) const {
    this->team_.each(count, work);
  }

 private:
  std::size_t size_;
};

/// WindowSolver::solve_by with a team, in pieces, the same result whatever the number of threads:
/// in a single piece, or in an order that pieces cannot keep, by one thread.
template <class Real>
[[nodiscard]] bool solve_by_windows(const OpenMP& executor, const TriangleMesh<Real>& mesh,
                                    std::span<const PointSource> sources, Accuracy accuracy,
                                    const PropagateOptions& options,
                                    WorkspaceState<Real>& workspace, DistanceField<Real>& field);

}  // namespace plexway::detail
