#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <span>

#include <plexway/complex/wireframe.hpp>
#include <plexway/propagate/distance_field.hpp>
#include <plexway/propagate/options.hpp>
#include <plexway/source/point_source.hpp>

#include "complex/number_range.hpp"
#include "propagate/progress_counter.hpp"
#include "propagate/workspace_state.hpp"

namespace plexway {

/// How often the dual queue may look at each edge before nearest first takes over. Up to here it is
/// the faster of the two: its expansions cost a quarter.
inline constexpr std::size_t wire_patience = 4;

/// One propagation over a wireframe, for any front.
///
/// Labels sit at the hinges, the vertices. A label that waits to be expanded is kept with its sign
/// turned: what an offer must look up, distance and whether it waits, is then one number.
template <class Real, class Step, bool kLabels>
class WirePropagation {
 public:
  static constexpr Real infinity = std::numeric_limits<Real>::infinity();

  WirePropagation(const Wireframe<Real>& wireframe, WorkspaceState<Real>& workspace,
                  const PropagateOptions& options)
      : wireframe_(wireframe),
        options_(options),
        radius_(static_cast<Real>(options.radius / wireframe.unit())) {
    const std::size_t n = wireframe.vertex_count();
    workspace.vertex.assign(n, infinity);
    if constexpr (kLabels) workspace.vertex_source.assign(n, none);
    label_ = workspace.vertex.data();
    source_ = workspace.vertex_source.data();
  }

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
    const Real sigma = static_cast<Real>(distance), known = label_[v];
    if (!(sigma < std::abs(known))) return false;
    label_[v] = -sigma;
    if constexpr (kLabels) source_[v] = number;
    front.push(v, sigma, !std::signbit(known));
    ++updates_;
    reached_ += known == infinity;
    return true;
  }

  /// Until no label waits or the budget is spent. False, with labels still waiting, if it took more
  /// than `patience` looks along an edge or at what waits. Throws Cancelled.
  template <class Front>
  bool spread(Front front, std::size_t patience) {
    const Index* const begin = wireframe_.begin().data();
    const WireArc<Real>* const arcs = wireframe_.arcs().data();
    Real* const label = label_;
    const Real radius = radius_;
    std::size_t left = left_, updates = 0, reached = 0, looks = 0;
    const auto keep = [&] { left_ = left, updates_ += updates, reached_ += reached; };
    const auto distance_of = [label, &looks](Index v) {
      ++looks;  // some queues look several times before it is a label's turn
      return std::abs(label[v]);
    };
    Index v = 0;
    while (front.pop(v, distance_of)) {
      const Real sigma = std::abs(label[v]);
      if (left == 0) [[unlikely]] {
        keep();
        updates = reached = 0;
        if (!take_stock(sigma)) {
          front.push(v, sigma, true);  // it waits on
          return true;
        }
        left = left_;
      }
      --left;
      label[v] = sigma;
      if (sigma > radius) [[unlikely]]
        continue;
      const Index first = begin[v], last = begin[v + 1];
      for (Index k = first; k < last; ++k) {
        const Index to = arcs[k].to;
        const Real offer = Step::over(sigma, arcs[k].length);
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

  /// Hands all that waits to another front.
  template <class Front>
  void hand_over(Front& front) const {
    for (std::size_t v = 0; v < wireframe_.vertex_count(); ++v)
      if (std::signbit(label_[v])) front.push(static_cast<Index>(v), -label_[v]);
  }

  /// For other ways to spread: the labels, and what was done to them.
  [[nodiscard]] Real* labels() const { return label_; }
  [[nodiscard]] Index* sources() const { return source_; }
  [[nodiscard]] Real radius() const { return radius_; }
  void account(const PropagateStatistics& done, bool out_of_budget) {
    granted_ += done.expansions;
    updates_ += done.updates;
    reached_ += done.reached_simplices;
    out_of_budget_ = out_of_budget;
  }

  /// No more than so many expansions from now on, of what was granted.
  void withdraw_all_but(std::size_t expansions) {
    const std::size_t kept = std::min(left_, expansions);
    granted_ -= left_ - kept;
    left_ = kept;
  }

  [[nodiscard]] bool out_of_budget() const { return out_of_budget_; }
  [[nodiscard]] PropagateStatistics statistics() const {
    return {granted_ - left_, updates_, reached_};
  }

  template <class Crew>
  void read_out(std::span<const PointSource> sources, const Crew& crew,
                DistanceField<Real>& field) const {
    NumberRange<Real>::check_unit(wireframe_.unit());
    const std::size_t n = wireframe_.vertex_count();
    field.distance.resize(n);
    field.label.resize(kLabels ? n : 0);
    const Real unit = static_cast<Real>(wireframe_.unit());
    const Real radius = static_cast<Real>(options_.radius);
    const std::span<const Index> inside = wireframe_.vertices_inside();
    crew.over(n, [&](std::size_t begin, std::size_t end) {
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
      tell_progress(options_, {granted_, reached_, wireframe_.vertex_count(),
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
  Real radius_;
  Real* label_;
  Index* source_;
  std::size_t left_ = 0, granted_ = 0, updates_ = 0, reached_ = 0;
  bool out_of_budget_ = false;
};

}  // namespace plexway
