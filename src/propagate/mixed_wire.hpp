#pragma once

#include <cmath>
#include <limits>

#include "propagate/mixed_piece.hpp"
#include "propagate/wire_propagation.hpp"
#include "propagate/wire_step.hpp"

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
        step_(step * static_cast<Real>(wireframe.summary().mean_edge / wireframe.unit())),
        front_(empty_front()),
        propagation_(wireframe, workspace, options_) {}

  void seed(const PointSource& source, Index number) override {
    propagation_.seed(source, number, front_);
  }

  void run(std::size_t budget, Index) override {
    options_.max_expansions = budget;
    if (!propagation_.spread(front_, 8 * wireframe_.arcs().size())) {
      PriorityQueue<Real> nearest_first(workspace_.front);
      propagation_.hand_over(nearest_first);
      propagation_.spread(nearest_first, std::numeric_limits<std::size_t>::max());
    }
    front_ = empty_front();
  }

  Found at_vertex(Index v) override {
    return {std::abs(workspace_.vertex[v]) * unit_, workspace_.vertex_source[v]};
  }
  bool enter_vertex(Index v, Real distance, Index source, bool) override {
    if (!this->gains(at_vertex(v).distance, distance)) return false;
    return propagation_.seed_vertex(v, static_cast<double>(distance / unit_), source, front_);
  }

  Real distance(Index) const override { return std::numeric_limits<Real>::infinity(); }
  Index vertex_of(Index, std::size_t) const override { return none; }
  HingeShape<Real> shape(const Member&, int) const override { return {}; }
  PosedSource<Real> leave(const Member&, int, const HingePlace<Real>&) const override { return {}; }
  bool enter(const Member&, int, const PosedSource<Real>&, Index) override { return false; }
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
  DualQueue<Real> empty_front() {
    return DualQueue<Real>(workspace_.front, step_ > 0 ? step_ : Real(1));
  }

  const Wireframe<Real>& wireframe_;
  WorkspaceState<Real>& workspace_;
  PropagateOptions options_;
  Real unit_, step_;
  DualQueue<Real> front_;
  WirePropagation<Real, WireStep<Real>, true> propagation_;
};

}  // namespace plexway
