#include <limits>
#include <type_traits>

#include "executors/checks.hpp"
#include "executors/run.hpp"
#include "executors/solve_wireframe.hpp"
#include "labels/alone.hpp"
#include "labels/wireframe/wire_propagation.hpp"
#include "labels/wireframe/wire_step.hpp"

namespace plexway {
namespace {

template <class Real, class Step, bool kLabels>
void solve(const Wireframe<Real>& wireframe, std::span<const PointSource> sources,
           const PropagateOptions& options, WorkspaceState<Real>& workspace,
           DistanceField<Real>& field) {
  WirePropagation<Real, Step, kLabels> propagation(wireframe, workspace, options);
  constexpr std::size_t unlimited = std::numeric_limits<std::size_t>::max();
  const auto start = [&](auto& front) {
    for (std::size_t n = 0; n < sources.size(); ++n)
      propagation.seed(sources[n], static_cast<Index>(n), front);
  };
  workspace.front.reserve(wireframe.vertex_count());
  if (options.schedule == Schedule::priority) {
    PriorityQueue<Real> front(workspace.front);
    start(front);
    propagation.spread(front, unlimited);
  } else if (options.schedule == Schedule::fifo) {
    DualQueue<Real> front(workspace.front, std::numeric_limits<Real>::infinity());
    start(front);
    propagation.spread(front, unlimited);
  } else {
    DualQueue<Real> front(workspace.front,
                          static_cast<Real>(options.step * wireframe.typical_edge()));
    start(front);
    if (!propagation.spread(front, wire_patience * wireframe.arcs().size())) {
      PriorityQueue<Real> nearest_first(workspace.front);
      propagation.hand_over(nearest_first);
      propagation.spread(nearest_first, unlimited);
    }
  }
  propagation.read_out(sources, Alone{}, field);
}

}  // namespace

template <class Real>
void solve_alone(const Wireframe<Real>& wireframe, std::span<const PointSource> sources,
                 const PropagateOptions& options, WorkspaceState<Real>& workspace,
                 DistanceField<Real>& field) {
  const auto with_step = [&](auto labels, auto step) {
    solve<Real, decltype(step), decltype(labels)::value>(wireframe, sources, options, workspace,
                                                         field);
  };
  const auto with_labels = [&](auto labels) {
    options.vectorised ? with_step(labels, WireStep<Real>{})
                       : with_step(labels, KernelWireStep<Real>{});
  };
  sources.size() > 1 ? with_labels(std::true_type{}) : with_labels(std::false_type{});
}

template void solve_alone(const Wireframe<float>&, std::span<const PointSource>,
                          const PropagateOptions&, WorkspaceState<float>&, DistanceField<float>&);
template void solve_alone(const Wireframe<double>&, std::span<const PointSource>,
                          const PropagateOptions&, WorkspaceState<double>&, DistanceField<double>&);

template <class Real>
void solve_points(const Serial&, const Wireframe<Real>& wireframe,
                  std::span<const PointSource> sources, const PropagateOptions& options,
                  Workspace<Real>& kept, DistanceField<Real>& field) {
  check(sources, options, wireframe);
  solve_alone(wireframe, sources, options, kept.state(), field);
}

#define PLEXWAY_COMPILE_WIRES(...) PLEXWAY_COMPILE(Serial, __VA_ARGS__)
PLEXWAY_WIREFRAMES(PLEXWAY_COMPILE_WIRES)
#undef PLEXWAY_COMPILE_WIRES

}  // namespace plexway
