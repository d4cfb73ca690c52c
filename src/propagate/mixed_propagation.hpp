#pragma once

#include <algorithm>
#include <array>
#include <limits>
#include <memory>
#include <vector>

#include <plexway/complex/mixed_complex.hpp>

#include "propagate/hinge_chains.hpp"
#include "propagate/mixed_piece.hpp"
#include "propagate/mixed_solid.hpp"
#include "propagate/mixed_surface.hpp"
#include "propagate/mixed_wire.hpp"

namespace plexway {

/// One propagation over a mixed domain: pieces take turns, and between them labels cross the welds.
template <class Real>
class MixedPropagation {
 public:
  using Domain = MixedComplex<Real>;
  using Member = typename Domain::Member;

  /// `offered` is room for what has crossed already.
  MixedPropagation(const Domain& domain, std::span<Workspace<Real>> workspaces,
                   std::vector<Real>& offered, const PropagateOptions& options)
      : domain_(domain),
        options_(options),
        offered_(offered),
        posed_(domain.members().size()),
        chains_(domain) {
    const Real step =
        options.schedule == Schedule::fifo ? infinity : static_cast<Real>(options.step);
    // What pieces count and report is summed up here.
    PropagateOptions mine = options;
    if (options.progress) mine.progress = [this](const Progress& p) { return report(p); };
    for (const auto& piece : domain.pieces()) {
      Workspace<Real>& workspace = workspaces[piece.number];
      const auto& complex = domain.complex(piece);
      if (const auto* surface = std::get_if<TriangleMesh<Real>>(&complex))
        pieces_.push_back(std::make_unique<MixedSurface<Real>>(*surface, workspace, mine, step));
      else if (const auto* solid = std::get_if<TetMesh<Real>>(&complex))
        pieces_.push_back(std::make_unique<MixedSolid<Real>>(*solid, workspace, mine, step));
      else
        pieces_.push_back(std::make_unique<MixedWire<Real>>(std::get<Wireframe<Real>>(complex),
                                                            workspace, mine, step));
    }
    waits_.assign(pieces_.size(), 0);
    offered_.assign(domain.members().size() + 2 * domain.welds().size(), infinity);
  }

  /// A source in the piece's own numbers. A welded vertex is one in its other pieces too.
  void seed(Index piece, const PointSource& source, Index number) {
    pieces_[piece]->seed(source, number);
    waits_[piece] = 1;
    if (source.vertex == none) return;
    const Index vertex = std::visit([&](const auto& c) { return c.inside_vertex(source.vertex); },
                                    domain_.complex(domain_.pieces()[piece]));
    for (const auto& weld : domain_.welds())
      for (const std::size_t side : {0, 1})
        if (weld.piece[side] == piece && weld.vertex[side] == vertex)
          if (pieces_[weld.piece[1 - side]]->enter_vertex(weld.vertex[1 - side],
                                                          static_cast<Real>(source.offset), number))
            waits_[weld.piece[1 - side]] = 1;
  }

  void run() {
    do {
      for (std::size_t p = 0; p < pieces_.size(); ++p) {
        if (!waits_[p]) continue;
        waits_[p] = 0;
        running_ = p;
        const std::size_t spent = expansions();
        const std::size_t left =
            options_.max_expansions > spent ? options_.max_expansions - spent : 0;
        const std::size_t own = pieces_[p]->statistics().expansions;
        constexpr std::size_t most = std::numeric_limits<std::size_t>::max();
        pieces_[p]->run(left > most - own ? most : own + left);
        if (pieces_[p]->out_of_budget()) complete_ = false;
      }
    } while (complete_ && cross());
  }

  /// One a vertex of the domain; `distance` and `label` are room for a piece.
  void read_out(std::vector<Real>& distance, std::vector<Index>& label,
                DistanceField<Real>& field) const {
    field.distance.assign(domain_.vertex_count(), infinity);
    field.label.assign(domain_.vertex_count(), none);
    for (const auto& piece : domain_.pieces()) {
      distance.resize(piece.vertices);
      label.resize(piece.vertices);
      pieces_[piece.number]->read_out(distance, label);
      std::copy(distance.begin(), distance.end(), field.distance.begin() + piece.first_vertex);
      std::copy(label.begin(), label.end(), field.label.begin() + piece.first_vertex);
    }
    field.complete = complete_;
    field.statistics = {};
    for (const auto& piece : pieces_) {
      const PropagateStatistics s = piece->statistics();
      field.statistics.expansions += s.expansions;
      field.statistics.updates += s.updates;
      field.statistics.reached_simplices += s.reached_simplices;
    }
  }

  /// After sources and welded vertices have had their say. True if some vertex got nearer.
  bool relax(DistanceField<Real>& field) const {
    bool any = false;
    for (const auto& piece : domain_.pieces())
      any |= pieces_[piece.number]->relax(
          std::span(field.distance).subspan(piece.first_vertex, piece.vertices),
          std::span(field.label).subspan(piece.first_vertex, piece.vertices));
    return any;
  }

 private:
  static constexpr Real infinity = std::numeric_limits<Real>::infinity();

  std::size_t expansions() const {
    std::size_t sum = 0;
    for (const auto& piece : pieces_) sum += piece->statistics().expansions;
    return sum;
  }

  bool report(const Progress& of_piece) const {
    Progress all = of_piece;
    all.simplices = domain_.simplex_count();
    for (std::size_t p = 0; p < pieces_.size(); ++p) {
      if (p == running_) continue;
      all.expansions += pieces_[p]->statistics().expansions;
      all.reached += pieces_[p]->statistics().reached_simplices;
    }
    return options_.progress(all);
  }

  // Over all hinges what has got better since. True if something was accepted.
  bool cross() {
    bool any = false;
    const auto accepted = [&](Index piece, bool yes) {
      if (yes) waits_[piece] = 1, any = true;
    };
    std::size_t slot = 0;
    for (const auto& weld : domain_.welds())
      for (const std::size_t side : {0, 1}) {
        Real& offered = offered_[slot++];
        if (!weld.hinge) continue;
        const auto found = pieces_[weld.piece[side]]->at_vertex(weld.vertex[side]);
        if (!(found.distance < offered)) continue;
        offered = found.distance;
        if (static_cast<double>(found.distance) > options_.radius) continue;
        const Index to = weld.piece[1 - side];
        accepted(to,
                 pieces_[to]->enter_vertex(weld.vertex[1 - side], found.distance, found.source));
      }
    // First what has got better, then all of that goes over.
    changed_.clear();
    for (Index n = 0; n < domain_.hinges().size(); ++n) {
      const auto& hinge = domain_.hinges()[n];
      for (const std::size_t side : {0, 1})
        for (Index m = hinge.begin[side]; m < hinge.end[side]; ++m) {
          const Member& member = domain_.members()[m];
          Real& offered = offered_[2 * domain_.welds().size() + m];
          const Real distance = pieces_[hinge.piece[side]]->distance(member.simplex);
          if (!(distance < offered)) continue;
          offered = distance;
          posed_[m] = pieces_[hinge.piece[side]]->leave(member, hinge.dimension);
          changed_.push_back({n, static_cast<Index>(side), m});
        }
    }
    // Over edges first: of equal paths, one with a ring serves more points than one that bends at
    // the best point for a single centre.
    std::stable_partition(changed_.begin(), changed_.end(), [&](const Change& change) {
      return domain_.hinges()[change.hinge].dimension == 1;
    });
    for (const auto& [n, side, m] : changed_) {
      const auto& hinge = domain_.hinges()[n];
      const Index to = hinge.piece[1 - side];
      Index ring = none;
      if (chains_.at_solid(n, 1 - side)) {
        const auto [low, high] = chains_.visible(n, side, posed_, m);
        ring = pieces_[to]->open_ring(domain_.members()[hinge.begin[1 - side]], low, high);
      }
      bool entered = false;
      for (Index k = hinge.begin[1 - side]; k < hinge.end[1 - side]; ++k)
        entered |= pieces_[to]->enter(domain_.members()[k], hinge.dimension, posed_[m], ring);
      accepted(to, entered);
      if (ring != none && !entered) pieces_[to]->close_ring();
    }
    return any;
  }

  const Domain& domain_;
  const PropagateOptions& options_;
  std::vector<Real>& offered_;
  std::vector<std::unique_ptr<MixedPiece<Real>>> pieces_;
  struct Change {
    Index hinge, side, member;
  };
  std::vector<Change> changed_;
  std::vector<PosedSource<Real>> posed_;  // by member: what it offered last
  HingeChains<Real> chains_;
  std::vector<char> waits_;
  std::size_t running_ = 0;
  bool complete_ = true;
};

}  // namespace plexway
