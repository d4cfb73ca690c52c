#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <deque>
#include <limits>
#include <span>
#include <vector>

#include <plexway/solid/tet_mesh.hpp>
#include "labels/progress_counter.hpp"

#include "complexes/partition/cut.hpp"
#include "complexes/partition/partition.hpp"
#include "executors/drive.hpp"
#include "executors/threads/rank_mail.hpp"
#include "executors/threads/scheduler.hpp"
#include "executors/threads/supersteps.hpp"
#include "labels/pieces/owned_piece.hpp"

namespace plexway {

/// A solid cut into pieces of about `size` tetrahedra, as it was last time if it is the same.
template <class Real>
void cut_solid(OwnedPieces& pieces, const TetMesh<Real>& mesh, std::size_t size) {
  if (pieces.identity == mesh.identity() && pieces.size == size) return;
  const auto tets = mesh.tets();
  const std::size_t count = mesh.tet_count();
  std::vector<std::array<float, 3>> middles;
  middles.reserve(count);
  if (mesh.embedded())
    for (std::size_t t = 0; t < count; ++t) {
      const auto& [x, y, z] = tets[t].centre;
      middles.push_back({static_cast<float>(x), static_cast<float>(y), static_cast<float>(z)});
    }
  const auto neighbours = [&](Index t, const auto& visit) {
    for (const Index across : tets[t].across)
      if (const Index u = across >> TetAcross::tet_shift; u != count) visit(u);
  };
  pieces = {};
  pieces.cut = cut(partition(count, size, middles, neighbours), neighbours);
  pieces.cut.piece_of.push_back(none);
  pieces.rooms.resize(pieces.cut.pieces.size());
  pieces.identity = mesh.identity();
  pieces.size = size;
}

/// A team does the work of a solve in a solid, piece by piece. Seeds, pinches and repairs are done
/// on the whole by one thread between runs, as for `Serial`.
template <class Real, bool kLabels>
class OwnedScheduler : public TeamScheduler<Real, kLabels> {
 public:
  using Base = TeamScheduler<Real, kLabels>;
  OwnedScheduler(const Base& base, OwnedPieces& pieces) : Base(base), pieces_(pieces) {}

  template <class Propagation, class Front>
  void run(Propagation& propagation, Front& front, std::size_t simplices) const {
    using Label = typename Front::Label;
    using Piece = OwnedPiece<Real, Label, Propagation, kLabels>;
    const Deal deal = this->team_.deal();
    std::deque<Piece> pieces;  // ours
    std::vector<Piece*> by_number(pieces_.rooms.size(), nullptr);
    for (std::size_t p = deal.ours; p < by_number.size(); p += deal.count) {
      OwnedRoom& room = pieces_.rooms[p];
      room.front.reserve(pieces_.cut.pieces[p].own);
      const typename Piece::Front::Base own(
          this->workspace_.marks, front.labels(), DualQueue<Real>(room.front, this->step_),
          this->workspace_.source.data(), simplices, this->unit_, this->options_);
      by_number[p] = &pieces.emplace_back(pieces_, static_cast<Index>(p), room, own, propagation);
    }
    /// A superstep's, in edges of a cube of so many tetrahedra: mean edges.
    constexpr double pace = 1. / 8;
    Supersteps<Piece> supersteps(
        this->team_, pieces_.cut, by_number,
        static_cast<Real>(pace * std::cbrt(static_cast<double>(pieces_.size))), simplices,
        this->unit_, this->options_, this->workspace_.pieces.counts());
    const auto goes_on = [&](std::size_t expansions, std::size_t) {
      check_end(expansions, simplices);
      return true;
    };
    const auto spread = [&](bool last_resort) {
      for (Piece& piece : pieces) piece.set_last_resort(last_resort);
      front.drain([&](Index s) {
        if (Piece* const piece = by_number[pieces_.cut.piece_of[s]]) piece->give(s);
      });
      supersteps.run_beside(front, goes_on);
      // Repairs look at all labels: those of other processes' tetrahedra, too.
      this->share_labels(by_number.size(), front, [&](std::size_t p, const auto& take) {
        const CutPiece& piece = pieces_.cut.pieces[p];
        for (const Index s : std::span(piece.simplices).first(piece.own))
          if (front.reached(s)) take(s, front.hinge(s), front.label(s), front.source(s));
      });
    };
    propagation.run(spread, [&](const auto& look) {
      this->search(
          simplices,
          [&](std::size_t t) { return propagation.may_need_repair(static_cast<Index>(t)); },
          [&](std::size_t t) { look(static_cast<Index>(t)); });
    });
  }

 private:
  OwnedPieces& pieces_;
};

/// In solids by pieces: a single one is the serial loop.
template <bool kLabels, class Real, class Solve>
void drive(const OpenMP& executor, const TetMesh<Real>& mesh, std::span<const PointSource> sources,
           const PropagateOptions& options, WorkspaceState<Real>& workspace, const Solve& solve) {
  const Team team(executor);
  const std::size_t size = piece_size(executor, mesh.tet_count(), {4096, 64});
  if (is_one_piece(size, mesh.tet_count())) {
    drive<kLabels>(Serial{}, mesh, sources, options, workspace, solve);
    return;
  }
  thread_local OwnedPieces pieces;  // of the last solid, so that a second solve cuts nothing
  cut_solid(pieces, mesh, size);
  workspace.front.reserve(mesh.tet_count());
  const DualQueue<Real> queue(workspace.front, std::numeric_limits<Real>::infinity());
  const TeamScheduler<Real, kLabels> scheduler(team, workspace, step_of<Real>(options), mesh.unit(),
                                               options);
  team.hold([&] { solve(queue, OwnedScheduler<Real, kLabels>(scheduler, pieces)); });
}

}  // namespace plexway
