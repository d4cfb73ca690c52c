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
#include "labels/front.hpp"
#include "labels/progress_counter.hpp"
#include "labels/workspace_state.hpp"

namespace plexway::detail {

/// To one who has all vertices.
struct AllVertices {
  [[nodiscard]] static constexpr bool has(Index) { return true; }
  template <class Real>
  static void tell(Index, Real, Index) {}
};

/// Labels of a wireframe spread along its arcs. An edge hands its virtual source on over a vertex:
/// the hinge kernel with K = 0. No straight line passes through a point, so every path bends there,
/// and what is left of the kernel is to walk to the hinge: sigma + length. (That this is the
/// relaxation of Dijkstra, A note on two problems in connexion with graphs, 1959, is how the field
/// knows it.) What all edges at a vertex learn from each other is that single number, so the label
/// belongs to the vertex. A label that waits to be expanded is kept with its sign turned: what an
/// offer must look up, distance and whether it waits, is then one number.
template <class Real, bool kLabels>
class WireSpread {
 public:
  static constexpr Real infinity = std::numeric_limits<Real>::infinity();

  /// `label` and, if kLabels, `source` of each vertex (numbers inside); `radius` in the unit
  /// inside.
  WireSpread(const Wireframe<Real>& wireframe, Real* label, Index* source, Real radius)
      : wireframe_(&wireframe), label_(label), source_(source), radius_(radius) {}

  /// The same, which has done nothing yet.
  [[nodiscard]] WireSpread anew() const { return {*wireframe_, label_, source_, radius_}; }

  /// A path of this length ends at a vertex: false if it knows a better one.
  template <class Front>
  bool offer(Index v, Real sigma, Index number, Front& front) {
    const Real known = label_[v];
    if (!(sigma < std::abs(known))) return false;
    label_[v] = -sigma;
    if constexpr (kLabels) source_[v] = number;
    front.push(v, sigma, !std::signbit(known));
    ++updates_;
    reached_ += known == infinity;
    return true;
  }

  /// Until no label waits. `left` expansions may be made; more(v, distance) is asked for others
  /// before v is expanded, and gives none to end it. False if it took more than `patience` looks
  /// along an arc or at what waits. where.has(v): is this vertex ours? If not, where.tell(v,
  /// distance, source) hears what is offered.
  template <class Front, class Where, class More>
  [[gnu::always_inline]] bool run(Front& front, const Where& where, std::size_t& left,
                                  std::size_t patience, const More& more) {
    const Index* const begin = wireframe_->begin().data();
    const WireArc<Real>* const arcs = wireframe_->arcs().data();
    Real* const label = label_;
    const Real radius = radius_;
    std::size_t share = left, updates = 0, reached = 0, looks = 0;
    const auto keep = [&] {
      left = share;
      updates_ += updates;
      reached_ += reached;
      updates = reached = 0;
      looks_ = looks;
    };
    const auto distance_of = [label, &looks](Index v) {
      ++looks;  // some queues look several times before it is a label's turn
      return std::abs(label[v]);
    };
    Index v = 0;
    while (front.pop(v, distance_of)) {
      const Real sigma = std::abs(label[v]);
      if (share == 0) [[unlikely]] {
        keep();
        if (!more(v, sigma)) return true;
        share = left;
      }
      --share;
      label[v] = sigma;
      if (sigma > radius) [[unlikely]]
        continue;
      const Index first = begin[v], last = begin[v + 1];
      for (Index k = first; k < last; ++k) {
        const Index to = arcs[k].to;
        const Real offer = sigma + arcs[k].length;
        if (!where.has(to)) [[unlikely]] {
          where.tell(to, offer, kLabels ? source_[v] : 0);
          continue;
        }
        const Real known = label[to];
        if (!(offer < std::abs(known))) continue;
        // It is expanded soon: its row, and where the row says that its arcs are.
        __builtin_prefetch(&begin[to]);
        __builtin_prefetch(&arcs[begin[to]]);
        label[to] = -offer;
        if constexpr (kLabels) source_[to] = source_[v];
        front.push(to, offer, !std::signbit(known));
        ++updates;
        reached += known == infinity;
      }
      looks += last - first;
      if (looks > patience) [[unlikely]] {
        keep();
        return false;
      }
    }
    keep();
    return true;
  }

  /// In the last run.
  [[nodiscard]] std::size_t looks() const { return looks_; }
  [[nodiscard]] std::size_t updates() const { return updates_; }
  [[nodiscard]] std::size_t reached() const { return reached_; }

 private:
  const Wireframe<Real>* wireframe_;
  Real* label_;
  Index* source_;
  Real radius_;
  std::size_t updates_ = 0, reached_ = 0, looks_ = 0;
};

/// What waits in a wireframe that others offer to as well, up to a horizon: in two queues, and when
/// those have looked too often nearest first.
template <class Real>
class WireFront {
 public:
  WireFront(FrontStorage& storage, Real step) : dual_(storage, step), heap_(storage) {}

  void push(Index v, Real distance, bool wanted = true) {
    if (sorted_) return heap_.push(v, distance);
    if (!wanted) dual_.note(distance);
    dual_.push(v, distance, wanted);
  }
  template <class DistanceOf>
  bool pop(Index& v, const DistanceOf& distance_of) {
    if (!sorted_) return dual_.pop(v, distance_of);
    return heap_.nearest() < horizon_ && heap_.pop(v, distance_of);
  }
  [[nodiscard]] Real nearest() const { return sorted_ ? heap_.nearest() : dual_.nearest(); }
  void set_horizon(Real horizon) {
    horizon_ = horizon;
    dual_.set_horizon(horizon);
  }
  /// From now on nearest first; whose label waits must be added anew.
  void sort() { sorted_ = true; }
  [[nodiscard]] bool sorted() const { return sorted_; }
  /// The two queues, which one who spreads by them alone may take and put back.
  [[nodiscard]] DualQueue<Real>& dual() { return dual_; }

 private:
  DualQueue<Real> dual_;
  PriorityQueue<Real> heap_;
  Real horizon_ = std::numeric_limits<Real>::infinity();
  bool sorted_ = false;
};

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
