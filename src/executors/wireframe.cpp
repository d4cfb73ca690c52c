// The loop: labels/wireframe/wire_propagation.hpp.

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <span>
#include <vector>

#include "executors/checks.hpp"
#include "executors/run.hpp"
#include "executors/threads/rank_mail.hpp"
#include "executors/threads/scheduler.hpp"
#include "executors/threads/supersteps.hpp"
#include "executors/threads/team.hpp"
#include "labels/alone.hpp"
#include "labels/front.hpp"
#include "labels/pieces/wire_piece.hpp"
#include "labels/wireframe/wire_propagation.hpp"

namespace plexway {
using namespace detail;
namespace {

template <class Real, bool kLabels>
void solve_alone(const Wireframe<Real>& wireframe, std::span<const PointSource> sources,
                 const PropagateOptions& options, WorkspaceState<Real>& workspace,
                 DistanceField<Real>& field) {
  start_wires<kLabels>(wireframe, workspace);
  WirePropagation<Real, kLabels> propagation(wireframe, workspace, options);
  workspace.front.reserve(wireframe.vertex_count());
  propagation.run(workspace.front, [&](auto& front) {
    for (std::size_t n = 0; n < sources.size(); ++n)
      propagation.seed(sources[n], static_cast<Index>(n), front);
  });
  propagation.read_out(sources, Alone{}, field);
}

// What seeds wait in until pieces take them.
template <class Real>
struct Seeds {
  std::vector<Index> vertex;
  void push(Index v, Real, bool wanted) {
    if (wanted) vertex.push_back(v);
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
template <bool kLabels, class Real>
std::size_t share_labels(PieceRanks* ranks, const RangeCut& cut, WorkspaceState<Real>& workspace) {
  const auto own = [&cut](auto& of, std::size_t p) {
    return std::span(of).subspan(cut.begin(p), cut.end(p) - cut.begin(p));
  };
  return share_pieces(
      ranks, cut.cut.pieces.size(),
      [&](std::size_t p, Parcel& parcel) {
        const auto add = [&parcel](auto values) {
          parcel.add(std::span<const typename decltype(values)::element_type>(values));
        };
        add(own(workspace.vertex, p));
        if constexpr (kLabels) add(own(workspace.vertex_source, p));
      },
      [&](std::size_t p, Unpacked mail) {
        mail.take(own(workspace.vertex, p));
        if constexpr (kLabels) mail.take(own(workspace.vertex_source, p));
      });
}

template <class Real, bool kLabels>
void solve_in_pieces(const Team& team, const Wireframe<Real>& wireframe,
                     std::span<const PointSource> sources, const PropagateOptions& options,
                     WorkspaceState<Real>& workspace, WirePieces<Real>& kept,
                     DistanceField<Real>& field) {
  using Piece = WirePiece<Real, kLabels>;
  start_wires<kLabels>(wireframe, workspace);
  WirePropagation<Real, kLabels> propagation(wireframe, workspace, options);
  Seeds<Real> seeds;
  for (std::size_t i = 0; i < sources.size(); ++i)
    propagation.seed(sources[i], static_cast<Index>(i), seeds);

  const Deal deal = team.deal();
  const RangeCut& cut = kept.cut;
  const Real step = step_of<Real>(options, wireframe.typical_edge());
  OurPieces<Piece> pieces(deal);
  deal.each(kept.rooms.size(), [&](std::size_t p) {
    const std::size_t arcs = wireframe.begin()[cut.end(p)] - wireframe.begin()[cut.begin(p)];
    pieces.add(kept, static_cast<Index>(p), workspace.vertex.data(), propagation.spread(), step,
               options.schedule == Schedule::fifo ? std::numeric_limits<std::size_t>::max()
                                                  : wire_patience * arcs);
  });
  for (const Index v : seeds.vertex)
    if (Piece* const piece = pieces.find(cut.piece_of(v))) piece->give(v);
  Supersteps<Piece> supersteps(
      team, cut.cut, pieces, static_cast<Real>(pace_of(cut) * wireframe.typical_edge()),
      wireframe.vertex_count(), wireframe.unit(), options, workspace.pieces.counts());
  const bool complete =
      supersteps.run(propagation.statistics(), [](std::size_t, std::size_t) { return true; });
  propagation.account(supersteps.statistics(), !complete);
  workspace.pieces.counts().sent += share_labels<kLabels>(team.ranks(), cut, workspace);
  propagation.read_out(sources, team, field);
}

template <class Real>
void solve_on(const Serial&, const Wireframe<Real>& wireframe, std::span<const PointSource> sources,
              const PropagateOptions& options, WorkspaceState<Real>& workspace,
              DistanceField<Real>& field) {
  with_labels(sources, [&](auto labels) {
    solve_alone<Real, decltype(labels)::value>(wireframe, sources, options, workspace, field);
  });
}

template <class Real>
void solve_on(const OpenMP& executor, const Wireframe<Real>& wireframe,
              std::span<const PointSource> sources, const PropagateOptions& options,
              WorkspaceState<Real>& workspace, DistanceField<Real>& field) {
  const Team team(executor);
  workspace.pieces.counts().start();
  const std::size_t n = wireframe.vertex_count();
  const std::size_t size = piece_size(executor, n);
  const auto alone = [&] { solve_on(Serial{}, wireframe, sources, options, workspace, field); };
  if (is_one_piece(size, n)) return alone();
  auto& pieces = workspace.pieces.template of<WirePieces<Real>>(wireframe, size, team.deal());
  if (executor.piece == 0 && !pays(wireframe, pieces.cut)) return alone();
  team.hold([&] {
    with_labels(sources, [&](auto labels) {
      solve_in_pieces<Real, decltype(labels)::value>(team, wireframe, sources, options, workspace,
                                                     pieces, field);
    });
  });
  workspace.pieces.counts().tell(field.statistics);
}

}  // namespace

template <class E, class Real>
void solve_points(const E& executor, const Wireframe<Real>& wireframe,
                  std::span<const PointSource> sources, const PropagateOptions& options,
                  Workspace<Real>& kept, DistanceField<Real>& field) {
  check(sources, options, wireframe);
  solve_on(executor, wireframe, sources, options, kept.state(), field);
}

PLEXWAY_WIREFRAMES(PLEXWAY_COMPILE_HERE)

}  // namespace plexway
