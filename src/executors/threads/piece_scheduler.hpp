#pragma once

#include <cmath>
#include <cstddef>
#include <span>
#include <utility>

#include <plexway/surface/triangle_mesh.hpp>

#include "executors/threads/rank_mail.hpp"
#include "executors/threads/scheduler.hpp"
#include "executors/threads/supersteps.hpp"
#include "labels/pieces/triangle_patches.hpp"
#include "labels/pieces/triangle_piece.hpp"

namespace plexway::detail {

/// How a surface is cut and how its pieces take turns. Of the surface alone, never of threads.
struct PieceSettings {
  std::size_t size;       ///< triangles a piece
  double pace = 1. / 16;  ///< a superstep's, in roots of the size: mean edges
};

/// A team does the work of a solve on a surface, piece by piece. Seeds, pinches, revivals and
/// repairs are done on the whole by one thread between runs, as for `Serial`, and read-out by all.
template <class Real, bool kLabels>
class PieceScheduler : public TeamScheduler<Real> {
 public:
  using Base = TeamScheduler<Real>;
  PieceScheduler(const Base& base, const TriangleMesh<Real>& mesh, const PieceSettings& settings)
      : Base(base), mesh_(mesh), settings_(settings) {}

  template <class Propagation, class Front>
  void run(Propagation& propagation, Front& front, std::size_t simplices) const {
    using Label = typename Front::Label;
    using PieceRule = decltype(propagation.rule().over(
        mesh_.triangles(), std::declval<PieceFront<Real, Label, kLabels>&>()));
    using Piece = TrianglePiece<Real, Label, PieceRule, kLabels>;
    const Deal deal = this->team_.deal();
    TrianglePatches<Real>& patches = patches_of(this->workspace_);
    const Cut& cut = patches.cut();
    OurPieces<Piece> pieces(deal);
    deal.each(patches.count(), [&](std::size_t p) {
      pieces.add(
          cut.pieces[p], patches[p].sheet(), patches[p], propagation.rule(),
          typename Piece::Settings{&this->options_, this->step_,
                                   static_cast<Real>(this->options_.radius / this->unit_),
                                   mesh_.summary().refracting_edges > 0, simplices, this->unit_});
    });
    const double pace = settings_.pace * std::sqrt(static_cast<double>(settings_.size));
    Supersteps<Piece> supersteps(this->team_, cut, pieces, static_cast<Real>(pace), simplices,
                                 this->unit_, this->options_, this->workspace_.pieces.counts());
    const auto goes_on = [&](std::size_t expansions, std::size_t) {
      check_end(expansions, simplices);
      return true;
    };
    propagation.run([&](bool last_resort) {
      front.drain([&](Index f) {
        if (Piece* const piece = pieces.find(cut.piece_of[f]))
          piece->give(cut.number_of[f], front.hinge(f), front.label(f),
                      propagation.rule().distance(f), front.source(f));
      });
      for (Piece& piece : pieces) piece.set_last_resort(last_resort);
      supersteps.run_beside(front, goes_on);
      // Where all is reached and fans do not touch, nobody looks at labels any more. And what was
      // just read is read out at once.
      const bool whole =
          front.out_of_budget() || front.reached_count() < simplices || !mesh_.pinched().empty();
      this->team_.each(pieces.size(), [&](std::size_t i) {
        if (whole)
          pieces[i].gather([&](Index f, std::size_t hinge, const Label& label, Index source) {
            front.know(f, hinge, label, source);
          });
        pieces[i].read_out();
      });
      if (whole) share_labels(pieces, patches.count(), front);
    });
  }

  /// After `run`: the distances of vertices.
  void read_out(WorkspaceState<Real>& workspace) const {
    const Deal deal = this->team_.deal();
    TrianglePatches<Real>& patches = patches_of(workspace);
    const auto take = [&](Index v, Real distance, Index source) {
      workspace.vertex[v] = distance;
      if constexpr (kLabels) workspace.vertex_source[v] = source;
    };
    const auto take_better = [&](Index v, Real distance, Index source) {
      bool better = distance < workspace.vertex[v];
      if constexpr (kLabels)
        better |= distance == workspace.vertex[v] && source < workspace.vertex_source[v];
      if (better) take(v, distance, source);
    };
    const auto source_of = [](const TrianglePatch<Real>& patch, std::size_t i) {
      return kLabels ? patch.vertex_source[i] : none;
    };
    this->team_.each(patches.count(), [&](std::size_t p) {
      if (!deal.is_ours(p)) return;
      const TrianglePatch<Real>& patch = patches[p];
      for (std::size_t i = patch.shared; i < patch.vertices.size(); ++i)
        take(patch.vertices[i], patch.vertex[i], source_of(patch, i));
    });
    deal.each(patches.count(), [&](std::size_t p) {
      const TrianglePatch<Real>& patch = patches[p];
      for (std::size_t i = 0; i < patch.shared; ++i)
        take_better(patch.vertices[i], patch.vertex[i], source_of(patch, i));
    });
    workspace.pieces.counts().sent += share_pieces(
        this->team_.ranks(), patches.count(),
        [&](std::size_t p, Parcel& parcel) {
          parcel.add(std::span<const Real>(patches[p].vertex));
          if constexpr (kLabels) parcel.add(std::span<const Index>(patches[p].vertex_source));
        },
        [&](std::size_t p, Unpacked distances) {
          const auto& vertices = patches[p].vertices;
          Unpacked sources(distances);
          if constexpr (kLabels) (void)sources.cut_off(vertices.size() * sizeof(Real));
          for (const Index v : vertices) {
            const Real distance = distances.template take<Real>();
            take_better(v, distance, kLabels ? sources.template take<Index>() : none);
          }
        });
  }

 private:
  /// Puts what other processes know of their triangles into the front.
  template <class Pieces, class Front>
  void share_labels(Pieces& pieces, std::size_t of_all, Front& front) const {
    struct Known {
      Index face, hinge, source;
      typename Front::Label label;
    };
    this->workspace_.pieces.counts().sent += share_pieces(
        this->team_.ranks(), of_all,
        [&](std::size_t p, Parcel& parcel) {
          pieces.find(p)->gather([&](Index f, std::size_t hinge, const auto& label, Index source) {
            parcel.add(Known{f, static_cast<Index>(hinge), source, label});
          });
        },
        [&](std::size_t, Unpacked mail) {
          while (!mail.empty()) {
            const Known known = mail.template take<Known>();
            front.know(known.face, known.hinge, known.label, known.source);
          }
        });
  }

  [[nodiscard]] TrianglePatches<Real>& patches_of(WorkspaceState<Real>& workspace) const {
    return workspace.pieces.template of<TrianglePatches<Real>>(mesh_, settings_.size,
                                                               this->team_.deal());
  }

  const TriangleMesh<Real>& mesh_;
  PieceSettings settings_;
};

}  // namespace plexway::detail
