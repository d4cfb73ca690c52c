#pragma once

#include <algorithm>
#include <cstddef>
#include <limits>
#include <span>

#include <plexway/complex/triangle_mesh.hpp>
#include <plexway/propagate/options.hpp>

#include "propagate/pieces/mail.hpp"
#include "propagate/pieces/piece_front.hpp"
#include "propagate/pieces/triangle_patches.hpp"
#include "propagate/read_out.hpp"
#include "propagate/triangle_spread.hpp"

namespace plexway {

/// A piece of a surface in one solve. A letter is the label of a triangle at a cut, for the ghost
/// that it is elsewhere; there it is expanded as if it were the piece's own. Not to be moved.
template <class Real, class SimplexLabel, class Rule, bool kLabels>
class TrianglePiece {
 public:
  using Number = Real;
  using Front = PieceFront<Real, SimplexLabel, kLabels>;
  struct Letter {
    Index to;  ///< the ghost
    Index source;
    Index hinge;
    SimplexLabel label;
  };

  /// What all pieces of a solve share.
  struct Settings {
    const PropagateOptions* options;
    Real step, radius;
    bool refracts;
    std::size_t faces;
    double unit;
  };

  /// `like` is the rule, on any front.
  template <class Like>
  TrianglePiece(const CutPiece& cut, TrianglePatch<Real>& patch, const Like& like,
                const Settings& settings)
      : cut_(cut),
        patch_(patch),
        front_(base(cut, patch, settings), cut.own),
        spread_(patch.triangles, like.over(patch.triangles, front_), front_, settings.radius,
                settings.refracts, settings.faces) {
    patch.posted.assign(cut.at_cut, std::numeric_limits<Real>::infinity());
    patch.is_new.assign(cut.at_cut, 0);
    for (Outbox& box : patch.mail.box) box.forget();
  }
  TrianglePiece(const TrianglePiece&) = delete;
  TrianglePiece& operator=(const TrianglePiece&) = delete;

  [[nodiscard]] const CutPiece& cut() const { return cut_; }
  [[nodiscard]] Outboxes& mail() { return patch_.mail; }

  /// A label from outside the supersteps.
  void give(Index i, std::size_t hinge, const SimplexLabel& label, Real distance, Index source) {
    from_outside([&] { front_.take(i, hinge, label, distance, source); });
  }
  /// Before the first superstep of a run: by the full rule everywhere?
  void set_last_resort(bool last_resort) { last_resort_ = last_resort; }

  /// No label that waits is nearer; +inf if none does.
  [[nodiscard]] Real nearest() const { return front_.queue().nearest(); }

  /// A letter to one of its ghosts.
  void take(const Letter& letter) {
    front_.put(letter.to, letter.label);
    const Real d = spread_.rule().distance(letter.to);
    // Nothing is offered back over the hinge that it came by.
    const unsigned ways = patch_.leads_in[letter.to - cut_.own] & ~(1u << letter.hinge);
    if (ways == 0)
      front_.know(letter.to, letter.hinge, letter.label, letter.source);
    else
      from_outside([&] { front_.take(letter.to, letter.hinge, letter.label, d, letter.source); });
  }

  /// As far as the horizon or so many expansions. `updates`: of all pieces until now.
  PieceWork run(Real horizon, std::size_t most, std::size_t updates) {
    PieceWork work;
    const std::size_t before = front_.expansions(), first = front_.reached_count();
    if (spread_.refracts()) [[unlikely]]
      spread_.limit(spread_.rule(), updates);
    front_.queue().set_horizon(horizon);
    front_.grant(most);
    Index last = 0;
    spread_.share(last_resort_, last);
    work.expansions = front_.expansions() - before;
    work.first = front_.reached_count() - first;
    return work;
  }

  /// Tells the peers of labels at the cut that got better. The least of their distances.
  Real post(std::size_t superstep, PieceWork& work) {
    constexpr Real infinity = std::numeric_limits<Real>::infinity();
    Outbox& box = patch_.mail.of(superstep);
    Real least = infinity;
    for (Index i = 0; i < cut_.at_cut; ++i) {
      if (!front_.reached(i) || front_.waits(i)) continue;
      const Real d = spread_.rule().distance(i);
      if (!(d < patch_.posted[i])) continue;
      patch_.posted[i] = d;
      patch_.is_new[i] = 1;
      least = std::min(least, d);
    }
    if (!(least < infinity)) return least;
    box.start<Letter>(superstep, cut_.peer_count(), cut_.slots.size());
    for (std::size_t peer = 0; peer < cut_.peer_count(); ++peer) {
      for (const CutPiece::Slot& slot : cut_.slots_of(peer))
        if (patch_.is_new[slot.here] != 0)
          box.add(Letter{slot.there, front_.source(slot.here),
                         static_cast<Index>(front_.hinge(slot.here)), front_.label(slot.here)});
      box.end_peer();
    }
    std::fill(patch_.is_new.begin(), patch_.is_new.end(), 0);
    work.letters = box.count();
    return least;
  }

  /// Of its own triangles, without what was given from outside.
  [[nodiscard]] PropagateStatistics statistics() const {
    return {front_.expansions(), front_.updates() - outside_.updates,
            front_.reached_count() - outside_.reached_simplices};
  }

  /// The least distance that its own triangles offer each of their vertices, and of equal ones that
  /// from the first source, into the patch.
  void read_out() {
    patch_.vertex.assign(patch_.vertices.size(), std::numeric_limits<Real>::infinity());
    if constexpr (kLabels) patch_.vertex_source.assign(patch_.vertices.size(), none);
    Real* const vertex = patch_.vertex.data();
    Index* const owner = patch_.vertex_source.data();
    Front front = front_;  // that nothing points to
    const auto rule = spread_.rule().on(front);
    const auto offer = [=, &front](Index v, Real d, Index f) {
      if constexpr (kLabels) {
        const Index source = front.source(f);
        if (d < vertex[v] || (d == vertex[v] && source < owner[v]))
          vertex[v] = d, owner[v] = source;
      } else {
        vertex[v] = std::min(vertex[v], d);
      }
    };
    const std::span<const TriangleRecord<Real>> triangles = patch_.triangles;
    const Index end = static_cast<Index>(cut_.own);
    if constexpr (requires { rule.label(0).x; })
      offer_apexes(triangles, rule, front, 0, end, offer);
    else
      offer_corners(triangles, rule, front, 0, end, offer);
  }

  /// take(triangle of the surface, hinge, label, source) for each of its own that is reached.
  template <class Take>
  void gather(const Take& take) const {
    for (Index i = 0; i < cut_.own; ++i)
      if (front_.reached(i))
        take(cut_.simplices[i], front_.hinge(i), front_.label(i), front_.source(i));
  }

 private:
  template <class Take>
  void from_outside(const Take& take) {
    const std::size_t updates = front_.updates(), reached = front_.reached_count();
    take();
    outside_.updates += front_.updates() - updates;
    outside_.reached_simplices += front_.reached_count() - reached;
  }

  static typename Front::Base base(const CutPiece& cut, TrianglePatch<Real>& patch,
                                   const Settings& settings) {
    const std::size_t count = cut.simplices.size();
    patch.marks.resize(count + 1);
    patch.marks.start();
    patch.marks.data()[count] = patch.marks.current();
    if constexpr (kLabels) patch.source.resize(count + 1);
    patch.front.reserve(count);
    return {patch.marks,
            patch.labels.template reserve<SimplexLabel>(count + 1),
            DualQueue<Real>(patch.front, settings.step),
            patch.source.data(),
            settings.faces,
            settings.unit,
            *settings.options};
  }

  const CutPiece& cut_;
  TrianglePatch<Real>& patch_;
  bool last_resort_ = false;
  Front front_;
  TriangleSpread<Real, Rule, Front> spread_;
  PropagateStatistics outside_;
};

}  // namespace plexway
