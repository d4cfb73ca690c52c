#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <functional>
#include <limits>
#include <memory>
#include <mutex>
#include <vector>

#include <plexway/complex/mixed_complex.hpp>

#include "propagate/hinge_chains.hpp"
#include "propagate/hinge_crossings.hpp"
#include "propagate/mixed_piece.hpp"
#include "propagate/mixed_solid.hpp"
#include "propagate/mixed_surface.hpp"
#include "propagate/mixed_wire.hpp"

namespace plexway {

/// Calls work(k, thread) for all k below a count, several at once; the caller's thread is 0.
using PiecesAtOnce = std::function<void(
    std::size_t count, const std::function<void(std::size_t k, std::size_t thread)>& work)>;

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
        chains_(domain),
        crossings_(domain, pieces_) {
    const Real step =
        options.schedule == Schedule::fifo ? infinity : static_cast<Real>(options.step);
    for (const auto& piece : domain.pieces()) {
      Workspace<Real>& workspace = workspaces[piece.number];
      // What pieces count and report is summed up here.
      PropagateOptions mine = options;
      if (options.progress)
        mine.progress = [this, p = pieces_.size()](const Progress& own) { return report(p, own); };
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
    reported_.resize(pieces_.size());
    on_callers_thread_.assign(pieces_.size(), 1);
    find_bends();
    offered_.assign(domain.members().size() + 2 * domain.welds().size(), infinity);
  }

  /// A source in the piece's own numbers. A welded vertex is one in its other pieces too.
  void seed(Index piece, const PointSource& source, Index number) {
    crossings_.keep_clear(number);
    pieces_[piece]->seed(source, number);
    waits_[piece] = 1;
    if (source.vertex == none) return;
    const Index vertex = std::visit([&](const auto& c) { return c.inside_vertex(source.vertex); },
                                    domain_.complex(domain_.pieces()[piece]));
    for (const auto& weld : domain_.welds())
      for (const std::size_t side : {0, 1})
        if (weld.piece[side] == piece && weld.vertex[side] == vertex)
          if (pieces_[weld.piece[1 - side]]->enter_vertex(
                  weld.vertex[1 - side], static_cast<Real>(source.offset), number, false))
            waits_[weld.piece[1 - side]] = 1;
  }

  /// Pieces that wait know nothing of each other until labels cross the welds: whether they run one
  /// after the other or `at_once`, the bits are the same.
  void run(const PiecesAtOnce& at_once) {
    std::vector<std::size_t> waiting;
    do {
      waiting.clear();
      for (std::size_t p = 0; p < pieces_.size(); ++p)
        if (std::exchange(waits_[p], 0) != 0) waiting.push_back(p);
      if (at_once && waiting.size() > 1) {
        at_once(waiting.size(), [&](std::size_t k, std::size_t thread) {
          run_piece(waiting[k], std::numeric_limits<std::size_t>::max(), thread == 0);
        });
      } else {
        for (const std::size_t p : waiting) {
          const std::size_t spent = expansions();
          run_piece(p, options_.max_expansions > spent ? options_.max_expansions - spent : 0, true);
        }
      }
      for (const std::size_t p : waiting)
        if (pieces_[p]->out_of_budget()) complete_ = false;
      // Bends at vertices last: they serve what nothing else reaches.
    } while (complete_ && (cross() || bend()));
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
      crossings_.straighten(piece.number, distance, label);
      for (Index& l : label) l = root(l);
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
  static constexpr Real bend_loss = MixedPiece<Real>::bend_loss;

  std::size_t expansions() const {
    std::size_t sum = 0;
    for (const auto& piece : pieces_) sum += piece->statistics().expansions;
    return sum;
  }

  void run_piece(std::size_t p, std::size_t left, bool on_callers_thread) {
    on_callers_thread_[p] = on_callers_thread;
    const std::size_t own = pieces_[p]->statistics().expansions;
    constexpr std::size_t most = std::numeric_limits<std::size_t>::max();
    pieces_[p]->run(left > most - own ? most : own + left, crossings_.first());
  }

  // The caller's function is called on the caller's thread.
  bool report(std::size_t piece, const Progress& own) {
    const std::scoped_lock lock(reporting_);
    reported_[piece] = own;
    if (on_callers_thread_[piece] == 0) return !stopped_;
    Progress all = own;
    all.simplices = domain_.simplex_count();
    for (std::size_t p = 0; p < pieces_.size(); ++p) {
      if (p == piece) continue;
      all.expansions += reported_[p].expansions;
      all.reached += reported_[p].reached;
    }
    if (!options_.progress(all)) stopped_ = true;
    return !stopped_;
  }

  [[nodiscard]] Index root(Index number) const { return crossings_.root(number); }

  [[nodiscard]] bool is_solid(Index piece) const {
    return std::holds_alternative<TetMesh<Real>>(domain_.complex(domain_.pieces()[piece]));
  }

  // Which hinges the two pieces measure alike; at which welded vertices paths may bend: where they
  // do not, and where a straight line of shared edges ends.
  void find_bends() {
    constexpr Real alike = Real(1e-6);
    std::vector<std::array<Index, 5>> at;  // pieces, vertices, weld
    for (Index w = 0; w < domain_.welds().size(); ++w) {
      const auto& weld = domain_.welds()[w];
      at.push_back({weld.piece[0], weld.piece[1], weld.vertex[0], weld.vertex[1], w});
    }
    std::sort(at.begin(), at.end());
    bends_.assign(domain_.welds().size(), none);
    isometric_.assign(domain_.hinges().size(), 0);
    for (Index n = 0; n < domain_.hinges().size(); ++n) {
      const auto& hinge = domain_.hinges()[n];
      const Member* member[2];
      for (const std::size_t side : {0, 1}) member[side] = &domain_.members()[hinge.begin[side]];
      // Solids that could not be joined bend paths at edges of the face between them.
      const bool window =
          hinge.dimension == 2 && is_solid(hinge.piece[0]) && is_solid(hinge.piece[1]);
      isometric_[n] =
          !window && pieces_[hinge.piece[0]]
                         ->shape(*member[0], hinge.dimension)
                         .agrees(pieces_[hinge.piece[1]]->shape(*member[1], hinge.dimension),
                                 hinge.dimension, alike);
      for (std::size_t i = 0; i <= hinge.dimension; ++i) {
        if (isometric_[n] && (hinge.dimension == 2 || !chains_.ends(n, i))) continue;
        const std::array<Index, 5> key = {
            hinge.piece[0], hinge.piece[1],
            pieces_[hinge.piece[0]]->vertex_of(member[0]->simplex, member[0]->corner[i]),
            pieces_[hinge.piece[1]]->vertex_of(member[1]->simplex, member[1]->corner[i]), 0};
        const auto found = std::lower_bound(at.begin(), at.end(), key);
        if (found != at.end() && std::equal(key.begin(), key.begin() + 4, found->begin()))
          bends_[(*found)[4]] = n;
      }
    }
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
        accepted(to, pieces_[to]->enter_vertex(weld.vertex[1 - side], found.distance,
                                               root(found.source), false));
      }
    // First what has got better, then all of that goes over.
    changed_.clear();
    for (Index n = 0; n < domain_.hinges().size(); ++n) {
      const auto& hinge = domain_.hinges()[n];
      for (const std::size_t side : {0, 1})
        for (Index m = hinge.begin[side]; m < hinge.end[side]; ++m) {
          const Member& member = domain_.members()[m];
          Real& offered = offered_[2 * domain_.welds().size() + m];
          const auto& piece = *pieces_[hinge.piece[side]];
          const Real distance = piece.distance(member.simplex);
          if (!(distance < offered)) continue;
          offered = distance;
          HingeFront<Real> front(piece, member, hinge.dimension, none, none);
          const bool one = front.is_one_source(posed_[m]);
          posed_[m].source = root(posed_[m].source);
          changed_.push_back({n, static_cast<Index>(side), m, one && isometric_[n]});
        }
    }
    // Over edges first: of equal paths, one with a ring serves more points than one that bends at
    // the best point for a single centre.
    std::stable_partition(changed_.begin(), changed_.end(), [&](const Change& change) {
      return domain_.hinges()[change.hinge].dimension == 1;
    });
    for (const auto& [n, side, m, as_it_is] : changed_) {
      const auto& hinge = domain_.hinges()[n];
      const Index to = hinge.piece[1 - side];
      if (as_it_is) {
        Index ring = none;
        if (chains_.at_solid(n, 1 - side)) {
          const auto [low, high] = chains_.visible(n, side, posed_, m);
          ring = pieces_[to]->open_ring(domain_.members()[hinge.begin[1 - side]], low, high);
        }
        bool entered = false;
        for (Index k = hinge.begin[1 - side]; k < hinge.end[1 - side]; ++k) {
          PosedSource<Real> posed = posed_[m];
          posed.sigma += gain_over(n, side, m, k);
          entered |= pieces_[to]->enter(domain_.members()[k], hinge.dimension, posed, ring);
        }
        accepted(to, entered);
        if (ring != none && !entered) pieces_[to]->close_ring();
        continue;
      }
      for (Index k = hinge.begin[1 - side]; k < hinge.end[1 - side]; ++k) {
        const HingeFront<Real> front(*pieces_[hinge.piece[side]], domain_.members()[m],
                                     hinge.dimension, posed_[m].source, crossings_.next());
        Vector3<Real> start = {0, 0, 0};
        if (!pieces_[to]->enter_front(domain_.members()[k], front, start)) continue;
        accepted(to, true);
        crossings_.add({posed_[m].source, n, static_cast<std::uint8_t>(side), start});
      }
    }
    return any;
  }

  // A source that is handed on must not be nearer to a point of the hinge than it was before, else
  // labels would gain on themselves going to and fro: what two measures of one hinge differ by.
  [[nodiscard]] Real gain_over(Index n, std::size_t side, Index m, Index k) const {
    const auto& hinge = domain_.hinges()[n];
    const auto before = pieces_[hinge.piece[side]]->shape(domain_.members()[m], hinge.dimension);
    const auto after = pieces_[hinge.piece[1 - side]]->shape(domain_.members()[k], hinge.dimension);
    const PosedSource<Real>& eye = posed_[m];
    const auto way = [&](const HingeShape<Real>& shape, const HingePlace<Real>& b) {
      const auto p = shape.place(b);
      return std::sqrt((p[0] - eye.x) * (p[0] - eye.x) + (p[1] - eye.y) * (p[1] - eye.y) +
                       eye.h * eye.h);
    };
    Real most = 0;
    for (int i = 0; i <= hinge.dimension; ++i) {
      const HingePlace<Real> b = {i == 1 ? Real(1) : Real(0), i == 2 ? Real(1) : Real(0)};
      most = std::max(most, way(before, b) - way(after, b));
    }
    return most;
  }

  // Over the vertices where paths may bend. True if something was accepted.
  bool bend() {
    bool any = false;
    for (std::size_t w = 0; w < domain_.welds().size(); ++w) {
      if (bends_[w] == none) continue;
      const auto& weld = domain_.welds()[w];
      for (const std::size_t side : {0, 1}) {
        Real& offered = offered_[2 * w + side];
        const auto found = pieces_[weld.piece[side]]->at_vertex(weld.vertex[side]);
        if (!(found.distance < offered)) continue;
        offered = found.distance;
        if (static_cast<double>(found.distance) > options_.radius) continue;
        const Index to = weld.piece[1 - side];
        if (!pieces_[to]->enter_vertex(weld.vertex[1 - side], found.distance, crossings_.next(),
                                       true))
          continue;
        crossings_.add({root(found.source), bends_[w], static_cast<std::uint8_t>(side),
                        pieces_[to]->place(weld.vertex[1 - side])});
        waits_[to] = 1;
        any = true;
      }
    }
    return any;
  }

  const Domain& domain_;
  const PropagateOptions& options_;
  std::vector<Real>& offered_;
  std::vector<std::unique_ptr<MixedPiece<Real>>> pieces_;
  struct Change {
    Index hinge, side, member;
    bool as_it_is;
  };
  std::vector<Change> changed_;
  std::vector<PosedSource<Real>> posed_;  // by member: what it offered last
  HingeChains<Real> chains_;
  HingeCrossings<Real> crossings_;
  std::vector<char> isometric_;  // by hinge
  std::vector<Index> bends_;     // by weld: a hinge at which a path may bend there, or none
  std::vector<char> waits_;
  std::vector<Progress> reported_;  // by piece
  std::mutex reporting_;
  bool stopped_ = false;
  std::vector<char> on_callers_thread_;  // by piece
  bool complete_ = true;
};

}  // namespace plexway
