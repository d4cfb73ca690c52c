#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <deque>
#include <limits>
#include <utility>

#include <plexway/complex/triangle_mesh.hpp>

#include "executors/crew.hpp"
#include "executors/supersteps.hpp"
#include "propagate/pieces/triangle_patches.hpp"
#include "propagate/pieces/triangle_piece.hpp"

namespace plexway {

/// How a surface is cut and how its pieces take turns. Of the surface alone, never of threads.
struct PieceSettings {
  std::size_t size;       ///< triangles a piece
  double pace = 1. / 16;  ///< a superstep's, in roots of the size: mean edges
};

/// A team does the work of a solve on a surface, piece by piece. Seeds, pinches, revivals and
/// repairs are done on the whole by one thread between runs, as for `Serial`, and read-out by all.
template <class Real, bool kLabels>
class PieceCrew : public TeamCrew<Real, kLabels> {
 public:
  using Base = TeamCrew<Real, kLabels>;
  PieceCrew(const Base& base, const TriangleMesh<Real>& mesh, const PieceSettings& settings)
      : Base(base), mesh_(mesh), settings_(settings) {}

  template <class Propagation, class Front>
  void run(Propagation& propagation, Front& front, std::size_t simplices) const {
    using Label = typename Front::Label;
    using PieceRule = decltype(propagation.rule().over(
        mesh_.triangles(), std::declval<PieceFront<Real, Label, kLabels>&>()));
    using Piece = TrianglePiece<Real, Label, PieceRule, kLabels>;
    TrianglePatches<Real>& patches = this->workspace_.pieces.of(mesh_, settings_.size);
    const Cut& cut = patches.cut();
    std::deque<Piece> pieces;
    for (std::size_t p = 0; p < patches.count(); ++p)
      pieces.emplace_back(
          cut.pieces[p], patches[p], propagation.rule(),
          typename Piece::Settings{&this->options_, this->step_,
                                   static_cast<Real>(this->options_.radius / this->unit_),
                                   mesh_.summary().refracting_edges > 0, simplices, this->unit_});
    const double pace = settings_.pace * std::sqrt(static_cast<double>(settings_.size));
    Supersteps<Piece> supersteps(this->team_, pieces, static_cast<Real>(pace), simplices,
                                 this->unit_, this->options_, this->workspace_.pieces.counts());
    const auto goes_on = [&](std::size_t expansions) {
      check_end(expansions, simplices);
      return true;
    };
    PropagateStatistics known;  // of the pieces
    propagation.run([&](bool last_resort) {
      front.drain([&](Index f) {
        pieces[cut.piece_of[f]].give(cut.number_of[f], front.hinge(f), front.label(f),
                                     propagation.rule().distance(f), front.source(f));
      });
      for (Piece& piece : pieces) piece.set_last_resort(last_resort);
      PropagateStatistics others = front.statistics();
      others.expansions -= known.expansions;
      others.updates -= known.updates;
      others.reached_simplices -= known.reached_simplices;
      const bool complete = supersteps.run(others, goes_on);
      PropagateStatistics now;
      for (const Piece& piece : pieces) {
        const PropagateStatistics own = piece.statistics();
        now.expansions += own.expansions;
        now.updates += own.updates;
        now.reached_simplices += own.reached_simplices;
      }
      front.account({now.expansions - known.expansions, now.updates - known.updates,
                     now.reached_simplices - known.reached_simplices},
                    !complete);
      known = now;
      // What looks at the whole looks for what is not reached and at pinched vertices. And what was
      // just read is read out at once.
      const bool whole = front.reached_count() < simplices || !mesh_.pinched().empty();
      this->team_.each(pieces.size(), [&](std::size_t p) {
        if (whole)
          pieces[p].gather([&](Index f, std::size_t hinge, const auto& label, Index source) {
            front.know(f, hinge, label, source);
          });
        pieces[p].read_out();
      });
    });
  }

  /// After `run`: the distances of vertices.
  void read_out(WorkspaceState<Real>& workspace) const {
    TrianglePatches<Real>& patches = workspace.pieces.of(mesh_, settings_.size);
    const auto take = [&](Index v, const TrianglePatch<Real>& patch, std::size_t i) {
      workspace.vertex[v] = patch.vertex[i];
      if constexpr (kLabels) workspace.vertex_source[v] = patch.vertex_source[i];
    };
    this->team_.each(patches.count(), [&](std::size_t p) {
      const TrianglePatch<Real>& patch = patches[p];
      for (std::size_t i = patch.shared; i < patch.vertices.size(); ++i)
        take(patch.vertices[i], patch, i);
    });
    for (std::size_t p = 0; p < patches.count(); ++p) {
      const TrianglePatch<Real>& patch = patches[p];
      for (std::size_t i = 0; i < patch.shared; ++i) {
        const Index v = patch.vertices[i];
        bool better = patch.vertex[i] < workspace.vertex[v];
        if constexpr (kLabels)
          better |= patch.vertex[i] == workspace.vertex[v] &&
                    patch.vertex_source[i] < workspace.vertex_source[v];
        if (better) take(v, patch, i);
      }
    }
  }

 private:
  const TriangleMesh<Real>& mesh_;
  PieceSettings settings_;
};

}  // namespace plexway
