#include <algorithm>
#include <cmath>
#include <cstddef>
#include <deque>
#include <limits>
#include <span>
#include <type_traits>
#include <vector>

#include "executors/checks.hpp"
#include "executors/run.hpp"
#include "executors/solve_wireframe.hpp"
#include "executors/threads/piece_post.hpp"
#include "executors/threads/piece_size.hpp"
#include "executors/threads/supersteps.hpp"
#include "executors/threads/team.hpp"
#include "labels/front.hpp"
#include "labels/pieces/wire_piece.hpp"
#include "labels/wireframe/wire_propagation.hpp"
#include "labels/wireframe/wire_step.hpp"

namespace plexway {

namespace {

// What seeds wait in until pieces take them.
template <class Real>
struct Seeds {
  std::vector<Index> vertex;
  void push(Index v, Real, bool wanted) {
    if (wanted) vertex.push_back(v);
  }
};

struct Readers {
  const Team& team;
  template <class Work>
  void over(std::size_t count, const Work& work) const {
    team.over(count, work);
  }
};

/// How far the horizon moves on in a superstep: a piece is so many edges across as there are arcs
/// for one at the cut.
double pace_of(const RangeCut& cut) {
  constexpr double pace = 1. / 8;
  return pace * static_cast<double>(cut.hinges) /
         static_cast<double>(std::max<std::size_t>(cut.at_cut, 1));
}

/// Do several threads gain anything? Not where an eighth of the arcs leads to other pieces, as
/// between any two vertices; where fewer do than in a plane grid, as in trees, so that the front is
/// a few vertices; nor where lengths are of very different size, and a pace says nothing.
template <class Real>
bool pays(const Wireframe<Real>& wireframe, const RangeCut& cut) {
  const double across =
      static_cast<double>(cut.hinges) / static_cast<double>(std::max<std::size_t>(cut.at_cut, 1));
  return across >= 8 && across <= 1.5 * std::sqrt(static_cast<double>(cut.size)) &&
         4 * wireframe.typical_edge() >= wireframe.summary().mean_edge / wireframe.unit();
}

/// The labels of other processes' vertices, and ours to them. Returns the bytes sent.
template <bool kLabels, class Propagation>
std::size_t share_labels(PieceRanks& ranks, Deal deal, const RangeCut& cut,
                         const Propagation& propagation) {
  const auto own = [&cut](auto* of, std::size_t p) {
    return std::span(of + cut.begin(p), of + cut.end(p));
  };
  const std::size_t count = cut.cut.pieces.size();
  const SharedPieces shared(ranks, deal, count, [&](std::size_t p, Parcel& parcel) {
    const auto add = [&parcel](auto values) {
      parcel.add(std::span<const typename decltype(values)::element_type>(values));
    };
    add(own(propagation.labels(), p));
    if constexpr (kLabels) add(own(propagation.sources(), p));
  });
  for (std::size_t p = 0; p < count; ++p) {
    if (deal.is_ours(p)) continue;
    Unpacked mail = shared.of(p);
    mail.take(own(propagation.labels(), p));
    if constexpr (kLabels) mail.take(own(propagation.sources(), p));
  }
  return shared.sent();
}

template <class Real, class Step, bool kLabels>
void solve(const Team& team, const Wireframe<Real>& wireframe, std::span<const PointSource> sources,
           const PropagateOptions& options, WorkspaceState<Real>& workspace, WirePieces<Real>& kept,
           DistanceField<Real>& field) {
  using Piece = WirePiece<Real, Step, kLabels>;
  WirePropagation<Real, Step, kLabels> propagation(wireframe, workspace, options);
  Seeds<Real> seeds;
  for (std::size_t i = 0; i < sources.size(); ++i)
    propagation.seed(sources[i], static_cast<Index>(i), seeds);

  const Deal deal = team.deal();
  const RangeCut& cut = kept.cut;
  const Real step = step_of<Real>(options, wireframe.typical_edge());
  std::deque<Piece> pieces;  // ours
  std::vector<Piece*> by_number(kept.rooms.size(), nullptr);
  for (std::size_t p = deal.ours; p < by_number.size(); p += deal.count) {
    const std::size_t arcs = wireframe.begin()[cut.end(p)] - wireframe.begin()[cut.begin(p)];
    by_number[p] = &pieces.emplace_back(
        kept, static_cast<Index>(p), propagation.labels(), propagation.spread(), step,
        options.schedule == Schedule::fifo ? std::numeric_limits<std::size_t>::max()
                                           : wire_patience * arcs);
  }
  for (const Index v : seeds.vertex)
    if (Piece* const piece = by_number[cut.piece_of(v)]) piece->give(v);
  Supersteps<Piece> supersteps(
      team, cut.cut, by_number, static_cast<Real>(pace_of(cut) * wireframe.typical_edge()),
      wireframe.vertex_count(), wireframe.unit(), options, workspace.pieces.counts());
  const bool complete =
      supersteps.run(propagation.statistics(), [](std::size_t, std::size_t) { return true; });
  propagation.account(supersteps.statistics(), !complete);
  if (PieceRanks* const ranks = team.ranks())
    workspace.pieces.counts().sent += share_labels<kLabels>(*ranks, deal, cut, propagation);
  propagation.read_out(sources, Readers{team}, field);
}

}  // namespace

template <class Real>
void solve_points(const OpenMP& executor, const Wireframe<Real>& wireframe,
                  std::span<const PointSource> sources, const PropagateOptions& options,
                  Workspace<Real>& kept, DistanceField<Real>& field) {
  WorkspaceState<Real>& workspace = kept.state();
  const Team team(executor);
  check(sources, options, wireframe);
  workspace.pieces.counts().start();
  const std::size_t n = wireframe.vertex_count();
  const std::size_t size = piece_size(executor, n, wire_pieces);
  thread_local WirePieces<Real> of_the_last;  // so that a second solve cuts nothing
  WirePieces<Real>& pieces = of_the_last;
  const bool one = is_one_piece(size, n);
  if (!one) pieces.of(wireframe, size);
  if (one || (executor.piece == 0 && !pays(wireframe, pieces.cut))) {
    solve_alone(wireframe, sources, options, workspace, field);
    return;
  }
  const auto with_step = [&](auto labels, auto step) {
    solve<Real, decltype(step), decltype(labels)::value>(team, wireframe, sources, options,
                                                         workspace, pieces, field);
  };
  const auto with_labels = [&](auto labels) {
    options.vectorised ? with_step(labels, WireStep<Real>{})
                       : with_step(labels, KernelWireStep<Real>{});
  };
  team.hold(
      [&] { sources.size() > 1 ? with_labels(std::true_type{}) : with_labels(std::false_type{}); });
  workspace.pieces.counts().tell(field.statistics);
}

#define PLEXWAY_COMPILE_WIRES(...)       \
  PLEXWAY_ELSEWHERE(Serial, __VA_ARGS__) \
  PLEXWAY_COMPILE(OpenMP, __VA_ARGS__)
PLEXWAY_WIREFRAMES(PLEXWAY_COMPILE_WIRES)
#undef PLEXWAY_COMPILE_WIRES

}  // namespace plexway
