#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <span>

#include <plexway/solve/distance_field.hpp>
#include <plexway/solve/options.hpp>
#include <plexway/source/point_source.hpp>
#include <plexway/wireframe/wireframe.hpp>

#include "labels/finish.hpp"
#include "labels/progress_counter.hpp"
#include "labels/wireframe/wire_spread.hpp"
#include "labels/workspace_state.hpp"

namespace plexway::detail {

/// How often the dual queue may look at each edge before nearest first takes over. Up to here it is
/// the faster of the two: its expansions cost a quarter.
inline constexpr std::size_t wire_patience = 4;

/// Calls offer(vertex, distance) for a source at a vertex, or for the ends of the edge that it lies
/// on: inside numbers and unit.
template <class Real, class Offer>
void offer_source(const Wireframe<Real>& wireframe, const PointSource& source, const Offer& offer) {
  const double sigma = source.offset / wireframe.unit();
  if (source.vertex != none) {
    offer(wireframe.inside_vertex(source.vertex), sigma);
    return;
  }
  const auto edge = wireframe.inside_edge(source.simplex);
  const std::array<double, 4>& b = source.barycentric;
  const double length = static_cast<double>(edge.length);
  if (b[1] != 1) offer(edge.from, sigma + b[1] * length);
  if (b[0] != 1) offer(edge.to, sigma + b[0] * length);
}

/// No vertex is reached.
template <bool kLabels, class Real>
void start_wires(const Wireframe<Real>& wireframe, WorkspaceState<Real>& workspace) {
  workspace.vertex.assign(wireframe.vertex_count(), std::numeric_limits<Real>::infinity());
  if constexpr (kLabels) workspace.vertex_source.assign(wireframe.vertex_count(), none);
}

/// One propagation over a wireframe, for any front, from what the workspace has.
template <class Real, bool kLabels>
class WirePropagation {
 public:
  WirePropagation(const Wireframe<Real>& wireframe, WorkspaceState<Real>& workspace,
                  const PropagateOptions& options)
      : wireframe_(wireframe),
        options_(options),
        workspace_(workspace),
        spread_(wireframe, workspace.vertex.data(), workspace.vertex_source.data(),
                static_cast<Real>(options.radius / wireframe.unit())) {}

  template <class Front>
  void seed(const PointSource& source, Index number, Front& front) {
    offer_source(wireframe_, source, [&](Index v, double distance) {
      spread_.offer(v, static_cast<Real>(distance), number, front);
    });
  }

  /// From what seed(front) adds until no label waits or the budget is spent, in the order of the
  /// options. Throws Cancelled.
  template <class Seed>
  void run(FrontStorage& storage, const Seed& seed) {
    constexpr std::size_t unlimited = std::numeric_limits<std::size_t>::max();
    if (options_.schedule == Schedule::priority) {
      PriorityQueue<Real> front(storage);
      seed(front);
      spread(front, unlimited);
      return;
    }
    DualQueue<Real> front(storage, step_of<Real>(options_, wireframe_.typical_edge()));
    seed(front);
    const bool endless = options_.schedule == Schedule::fifo;
    if (spread(front, endless ? unlimited : wire_patience * wireframe_.arcs().size())) return;
    PriorityQueue<Real> nearest_first(storage);
    hand_over(nearest_first);
    spread(nearest_first, unlimited);
  }

  /// Until no label waits or the budget is spent. False, with labels still waiting, if it took more
  /// than `patience` looks along an edge or at what waits. Throws Cancelled.
  template <class Front>
  bool spread(Front front, std::size_t patience) {
    return spread_.run(front, AllVertices{}, left_, patience, [&](Index v, Real sigma) {
      if (take_stock(sigma)) return true;
      front.push(v, sigma, true);  // it waits on
      return false;
    });
  }

  /// Hands all that waits to another front.
  template <class Front>
  void hand_over(Front& front) const {
    for (std::size_t v = 0; v < wireframe_.vertex_count(); ++v)
      if (const Real label = workspace_.vertex[v]; std::signbit(label))
        front.push(static_cast<Index>(v), -label);
  }

  /// For other ways to spread, and what they did.
  [[nodiscard]] const WireSpread<Real, kLabels>& spread() const { return spread_; }
  void account(const PropagateStatistics& done, bool out_of_budget) {
    granted_ += done.expansions;
    others_.updates += done.updates;
    others_.reached_simplices += done.reached_simplices;
    out_of_budget_ = out_of_budget;
  }

  [[nodiscard]] bool out_of_budget() const { return out_of_budget_; }
  [[nodiscard]] PropagateStatistics statistics() const {
    return {granted_ - left_, spread_.updates() + others_.updates,
            spread_.reached() + others_.reached_simplices};
  }

  template <class Scheduler>
  void read_out(std::span<const PointSource> sources, const Scheduler& scheduler,
                DistanceField<Real>& field) const {
    finish<Real, kLabels>(wireframe_, sources, options_, *this, workspace_, scheduler, field);
  }

 private:
  /// Grants the next share of the budget and reports progress; false if the budget is spent.
  bool take_stock(Real distance) {
    if (options_.progress && granted_ > 0)
      tell_progress(options_, {granted_, statistics().reached_simplices, wireframe_.vertex_count(),
                               static_cast<double>(distance) * wireframe_.unit()});
    constexpr std::size_t share = 65536;
    left_ = granted_ < options_.max_expansions ? std::min(share, options_.max_expansions - granted_)
                                               : 0;
    granted_ += left_;
    out_of_budget_ = left_ == 0;
    return !out_of_budget_;
  }

  const Wireframe<Real>& wireframe_;
  const PropagateOptions& options_;
  const WorkspaceState<Real>& workspace_;
  WireSpread<Real, kLabels> spread_;
  std::size_t left_ = 0, granted_ = 0;
  PropagateStatistics others_;  // what others did, without expansions
  bool out_of_budget_ = false;
};

}  // namespace plexway::detail
