#include <cmath>
#include <limits>
#include <type_traits>
#include <vector>

#include "executors/checks.hpp"
#include "executors/crew.hpp"
#include "executors/run.hpp"
#include "executors/unordered.hpp"
#include "propagate/wire_propagation.hpp"
#include "propagate/wire_step.hpp"

namespace plexway {
namespace {

// In a wireframe the distance of a vertex is all that there is to a label.
struct NoLabel {};

template <class Real, bool kLabels>
class WireStore {
 public:
  using Label = NoLabel;

  WireStore(Real* distance, Index* source) : distance_(distance), source_(source) {}
  [[nodiscard]] Real distance(Index v) const { return distance_[v]; }
  [[nodiscard]] Index source(Index v) const {
    if constexpr (kLabels) return source_[v];
    return 0;
  }
  template <class Offer>
  bool settle(const Offer& offer) const {
    const bool known = distance_[offer.simplex] < std::numeric_limits<Real>::infinity();
    distance_[offer.simplex] = OfferKey<Real>::distance(offer.key);
    if constexpr (kLabels) source_[offer.simplex] = offer.tie >> OfferTie::source_shift;
    return !known;
  }
  void prefetch(Index v) const { __builtin_prefetch(&distance_[v], 1); }

 private:
  Real* distance_;
  Index* source_;
};

// Offers along all edges of a vertex.
template <class Real, class Step, class Front>
struct WireExpander {
  const Index* begin;
  const WireArc<Real>* arcs;
  Real radius;
  Front& front;

  void operator()(Index v) const {
    const Real sigma = front.distance(v);
    if (sigma > radius) return;
    const Index source = front.source(v);
    for (Index k = begin[v]; k < begin[v + 1]; ++k) {
      const Real offer = Step::over(sigma, arcs[k].length);
      if (offer < front.distance(arcs[k].to)) front.accept(arcs[k].to, 0, {}, offer, source);
    }
  }
  void far_ahead(Index v) const { __builtin_prefetch(&begin[v]); }
  void ahead(Index v) const { __builtin_prefetch(&arcs[begin[v]]); }
};

// What seeds wait in until the team takes over.
template <class Real>
struct Seeds {
  std::vector<Index> vertex;
  void push(Index v, Real, bool wanted) {
    if (wanted) vertex.push_back(v);
  }
};

template <class Real, class Step, bool kLabels>
void solve(const Team& team, const Wireframe<Real>& wireframe, std::span<const PointSource> sources,
           const PropagateOptions& options, WorkspaceState<Real>& workspace,
           DistanceField<Real>& field) {
  const std::size_t n = wireframe.vertex_count();
  WirePropagation<Real, Step, kLabels> propagation(wireframe, workspace, options);
  Seeds<Real> seeds;
  for (std::size_t i = 0; i < sources.size(); ++i)
    propagation.seed(sources[i], static_cast<Index>(i), seeds);

  workspace.front.reserve(n);
  const Real step = step_of<Real>(options, wireframe.typical_edge());
  const TeamCrew<Real, kLabels> crew(team, workspace, step, wireframe.unit(), options);
  Real* const label = propagation.labels();
  const WireStore<Real, kLabels> store(label, propagation.sources());
  using WireRounds = Rounds<Real, WireStore<Real, kLabels>>;
  WireRounds rounds(team, workspace.team, store, workspace.front.far.get(), n, step,
                    wireframe.unit(), options);
  for (const Index v : seeds.vertex) {
    label[v] = std::abs(label[v]);
    rounds.add(v, 0, {}, label[v], store.source(v));
  }
  const std::size_t patience = options.schedule == Schedule::fifo
                                   ? std::numeric_limits<std::size_t>::max()
                                   : wire_patience * n;
  const bool complete = rounds.run(
      [&](auto& front) {
        return WireExpander<Real, Step, std::decay_t<decltype(front)>>{
            wireframe.begin().data(), wireframe.arcs().data(), propagation.radius(), front};
      },
      propagation.statistics(), patience);
  // What a label waits for is not kept beside it; where rounds end early, its sign says so again.
  if (!complete) rounds.hand_over([&](Index v) { label[v] = -std::abs(label[v]); });
  PropagateStatistics done = rounds.done();
  done.updates -= std::min(done.updates, seeds.vertex.size());
  propagation.account(done, rounds.out_of_budget());
  if (!complete && !rounds.out_of_budget()) {
    // Lengths of very different size: one thread, nearest first, is what helps.
    PriorityQueue<Real> nearest_first(workspace.front);
    propagation.hand_over(nearest_first);
    propagation.spread(nearest_first, std::numeric_limits<std::size_t>::max());
  }
  propagation.read_out(sources, crew, field);
}

}  // namespace

template <class Real>
void solve_points(const OpenMP& executor, const Wireframe<Real>& wireframe,
                  std::span<const PointSource> sources, const PropagateOptions& options,
                  Workspace<Real>& kept, DistanceField<Real>& field) {
  WorkspaceState<Real>& workspace = kept.state();
  const Team team(executor);
  check(sources, options, wireframe);
  check_ties(sources);
  const auto with_step = [&](auto labels, auto step) {
    solve<Real, decltype(step), decltype(labels)::value>(team, wireframe, sources, options,
                                                         workspace, field);
  };
  const auto with_labels = [&](auto labels) {
    options.vectorised ? with_step(labels, WireStep<Real>{})
                       : with_step(labels, KernelWireStep<Real>{});
  };
  sources.size() > 1 ? with_labels(std::true_type{}) : with_labels(std::false_type{});
}

namespace detail {
#define PLEXWAY_COMPILE_WIRES(...)       \
  PLEXWAY_ELSEWHERE(Serial, __VA_ARGS__) \
  PLEXWAY_COMPILE(OpenMP, __VA_ARGS__)
PLEXWAY_WIREFRAMES(PLEXWAY_COMPILE_WIRES)
#undef PLEXWAY_COMPILE_WIRES
}  // namespace detail

}  // namespace plexway
