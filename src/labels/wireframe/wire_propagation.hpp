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

#include "complexes/common/number_range.hpp"
#include "labels/progress_counter.hpp"
#include "labels/wireframe/wire_spread.hpp"
#include "labels/workspace_state.hpp"

namespace plexway {

/// How often the dual queue may look at each edge before nearest first takes over. Up to here it is
/// the faster of the two: its expansions cost a quarter.
inline constexpr std::size_t wire_patience = 4;

/// No vertex is reached.
template <bool kLabels, class Real>
void start_wires(const Wireframe<Real>& wireframe, WorkspaceState<Real>& workspace) {
  workspace.vertex.assign(wireframe.vertex_count(), std::numeric_limits<Real>::infinity());
  if constexpr (kLabels) workspace.vertex_source.assign(wireframe.vertex_count(), none);
}

/// One propagation over a wireframe, for any front, from what the workspace has.
template <class Real, class Step, bool kLabels>
class WirePropagation {
 public:
  static constexpr Real infinity = std::numeric_limits<Real>::infinity();

  WirePropagation(const Wireframe<Real>& wireframe, WorkspaceState<Real>& workspace,
                  const PropagateOptions& options)
      : wireframe_(wireframe),
        options_(options),
        label_(workspace.vertex.data()),
        source_(workspace.vertex_source.data()),
        spread_(wireframe, label_, source_, static_cast<Real>(options.radius / wireframe.unit())) {}

  template <class Front>
  void seed(const PointSource& source, Index number, Front& front) {
    const double sigma = source.offset / wireframe_.unit();
    if (source.vertex != none) {
      seed_vertex(wireframe_.inside_vertex(source.vertex), sigma, number, front);
      return;
    }
    const auto edge = wireframe_.inside_edge(source.simplex);
    const std::array<double, 4>& b = source.barycentric;
    const double length = static_cast<double>(edge.length);
    if (b[1] != 1) seed_vertex(edge.from, sigma + b[1] * length, number, front);
    if (b[0] != 1) seed_vertex(edge.to, sigma + b[0] * length, number, front);
  }

  /// A path of this length ends at a vertex (number inside); false if it knows a better one.
  template <class Front>
  bool seed_vertex(Index v, double distance, Index number, Front& front) {
    return spread_.offer(v, static_cast<Real>(distance), number, front);
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
      if (std::signbit(label_[v])) front.push(static_cast<Index>(v), -label_[v]);
  }

  /// For other ways to spread: the labels, and what was done to them.
  [[nodiscard]] Real* labels() const { return label_; }
  [[nodiscard]] Index* sources() const { return source_; }
  [[nodiscard]] const WireSpread<Real, Step, kLabels>& spread() const { return spread_; }
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
    NumberRange<Real>::check_unit(wireframe_.unit());
    const std::size_t n = wireframe_.vertex_count();
    field.distance.resize(n);
    field.label.resize(kLabels ? n : 0);
    const Real unit = static_cast<Real>(wireframe_.unit());
    const Real radius = static_cast<Real>(options_.radius);
    const std::span<const Index> inside = wireframe_.vertices_inside();
    scheduler.over(n, [&](std::size_t begin, std::size_t end) {
      for (std::size_t v = begin; v < end; ++v) {
        const Real d = std::abs(label_[inside[v]]) * unit;
        const bool in = d <= radius;
        field.distance[v] = in ? d : infinity;
        if constexpr (kLabels) field.label[v] = in && d < infinity ? source_[inside[v]] : none;
      }
    });
    // An offset survives scaling exactly.
    for (const PointSource& s : sources)
      if (s.vertex != none && s.offset <= options_.radius)
        field.distance[s.vertex] = std::min(field.distance[s.vertex], static_cast<Real>(s.offset));
    field.complete = !out_of_budget_;
    field.statistics = statistics();
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
  Real* label_;
  Index* source_;
  WireSpread<Real, Step, kLabels> spread_;
  std::size_t left_ = 0, granted_ = 0;
  PropagateStatistics others_;  // what others did, without expansions
  bool out_of_budget_ = false;
};

}  // namespace plexway
