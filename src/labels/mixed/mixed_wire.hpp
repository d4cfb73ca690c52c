#pragma once

#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

#include "labels/mixed/mixed_piece.hpp"
#include "labels/wireframe/wire_propagation.hpp"
#include "labels/wireframe/wire_spread.hpp"

namespace plexway {

/// A wireframe in a mixed domain. Its labels sit at the vertices: every hinge is one.
template <class Real>
class MixedWire final : public MixedPiece<Real> {
 public:
  using typename MixedPiece<Real>::Member;
  using typename MixedPiece<Real>::Found;

  MixedWire(const Wireframe<Real>& wireframe, WorkspaceState<Real>& workspace,
            const PropagateOptions& options, Real step)
      : wireframe_(wireframe),
        workspace_(prepare(wireframe, workspace)),
        options_(options),
        unit_(static_cast<Real>(wireframe.unit())),
        waiting_(workspace.front, step_of(wireframe, step)),
        propagation_(wireframe, workspace, options_) {}

  void seed(const PointSource& source, Index number) override {
    propagation_.seed(source, number, waiting_);
  }

  void run(Real horizon, std::size_t budget) override {
    options_.max_expansions = budget;
    propagation_.withdraw_all_but(budget - propagation_.statistics().expansions);
    waiting_.set_horizon(horizon / unit_);
    constexpr std::size_t all = std::numeric_limits<std::size_t>::max();
    const std::size_t patience = waiting_.sorted() ? all : 8 * wireframe_.arcs().size();
    if (propagation_.spread(NextWaiting{waiting_, this->expanded_}, patience)) return;
    waiting_.sort();
    propagation_.hand_over(waiting_);
    propagation_.spread(NextWaiting{waiting_, this->expanded_}, all);
  }
  Real nearest() const override { return waiting_.nearest() * unit_; }
  void hold() override { waiting_.set_horizon(0); }
  bool repair() override { return false; }

  Found at_vertex(Index v) override {
    return {std::abs(workspace_.vertex[v]) * unit_, workspace_.vertex_source[v]};
  }
  bool enter_vertex(Index v, Real distance, Index source, bool) override {
    if (!this->gains(at_vertex(v).distance, distance)) return false;
    return propagation_.seed_vertex(v, static_cast<double>(distance / unit_), source, waiting_);
  }

  Real distance(Index) const override { return std::numeric_limits<Real>::infinity(); }
  Index vertex_of(Index, std::size_t) const override { return none; }
  HingeShape<Real> shape(const Member&, int) const override { return {}; }
  PosedSource<Real> leave(const Member&, int, const HingePlace<Real>&) const override { return {}; }
  bool enter(const Member&, int, const PosedSource<Real>&, const std::pair<Real, Real>&) override {
    return false;
  }
  bool enter_front(const Member&, const HingeFront<Real>&, Vector3<Real>&) override {
    return false;
  }

  void read_out(std::span<Real> distance, std::span<Index> label) override {
    for (std::size_t v = 0; v < distance.size(); ++v) {
      const Found found = at_vertex(wireframe_.vertices_inside()[v]);
      distance[v] = found.distance;
      label[v] = found.source;
    }
  }

  PropagateStatistics statistics() const override { return propagation_.statistics(); }
  bool out_of_budget() const override { return propagation_.out_of_budget(); }

 private:
  static WorkspaceState<Real>& prepare(const Wireframe<Real>& wireframe,
                                       WorkspaceState<Real>& workspace) {
    workspace.front.reserve(wireframe.vertex_count());
    return workspace;
  }
  static Real step_of(const Wireframe<Real>& wireframe, Real step) {
    const auto edge = static_cast<Real>(wireframe.summary().mean_edge / wireframe.unit());
    return step * edge > 0 ? step * edge : Real(1);
  }

  /// What waits, for one spread; what it expands is listed.
  struct NextWaiting {
    WireFront<Real>& waiting;
    std::vector<Index>& expanded;
    void push(Index v, Real distance, bool wanted) { waiting.push(v, distance, wanted); }
    template <class DistanceOf>
    bool pop(Index& v, const DistanceOf& distance_of) {
      if (!waiting.pop(v, distance_of)) return false;
      expanded.push_back(v);
      return true;
    }
  };

  const Wireframe<Real>& wireframe_;
  WorkspaceState<Real>& workspace_;
  PropagateOptions options_;
  Real unit_;
  WireFront<Real> waiting_;
  WirePropagation<Real, WireStep<Real>, true> propagation_;
};

}  // namespace plexway
