#pragma once

#include <algorithm>
#include <cstddef>
#include <limits>

#include <plexway/common/ids.hpp>
#include <plexway/solve/options.hpp>
#include <plexway/surface/triangle_mesh.hpp>

#include "labels/front.hpp"
#include "labels/pieces/mail.hpp"
#include "labels/pieces/triangle_patches.hpp"
#include "labels/read_out.hpp"
#include "labels/surface/triangle_propagation.hpp"
#include "labels/wavefront.hpp"

namespace plexway::detail {

/// The front inside a piece: what is offered to ghosts is their own piece's to find out.
template <class Real, class SimplexLabel, bool kLabels>
class PieceFront : public Wavefront<Real, SimplexLabel, DualQueue<Real>, kLabels> {
 public:
  using Base = Wavefront<Real, SimplexLabel, DualQueue<Real>, kLabels>;
  using typename Base::Label;

  PieceFront(const Base& base, std::size_t own) : Base(base), own_(static_cast<Index>(own)) {}

  [[gnu::always_inline]] void accept(Index s, std::size_t hinge, const Label& label, Real distance,
                                     Index source) {
    if (s < own_) [[likely]]
      Base::accept(s, hinge, label, distance, source);
  }

  /// So many simplices take what they are offered: those of the piece, or the ghosts, too.
  void set_open(std::size_t simplices) { own_ = static_cast<Index>(simplices); }

 private:
  Index own_;
};

/// A piece of a surface in one solve. A message is the label of a triangle at a cut, for the ghost
/// that it is elsewhere; there it is expanded as if it were the piece's own. Not to be moved.
template <class Real, class SimplexLabel, class Rule, bool kLabels>
class TrianglePiece {
 public:
  using Number = Real;
  using Front = PieceFront<Real, SimplexLabel, kLabels>;
  struct Message {
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
  TrianglePiece(const CutPiece& cut, const TriangleSheet<Real>& sheet, TriangleRoom<Real>& room,
                const Like& like, const Settings& settings)
      : cut_(cut),
        sheet_(sheet),
        room_(room),
        front_(base(cut, room, settings), cut.own),
        spread_(sheet.triangles, like.over(sheet.triangles, front_), front_, settings.radius,
                settings.refracts, settings.faces) {
    // What is no ghost anywhere has told all.
    room.posted.assign(cut.at_cut, -std::numeric_limits<Real>::infinity());
    for (const CutPiece::Slot& slot : cut.slots)
      room.posted[slot.here] = std::numeric_limits<Real>::infinity();
    room.is_new.assign(cut.at_cut, 0);
    room.mail.forget();
  }
  TrianglePiece(const TrianglePiece&) = delete;
  TrianglePiece& operator=(const TrianglePiece&) = delete;

  [[nodiscard]] Outboxes& mail() { return room_.mail; }

  /// A label from outside the supersteps.
  void give(Index i, std::size_t hinge, const SimplexLabel& label, Real distance, Index source) {
    from_outside([&] { front_.take(i, hinge, label, distance, source); });
  }
  /// Between runs work() may offer labels to its own triangles, by rule() on front(); if `ghosts`
  /// to those as well. What is reached by that with ghosts does not count.
  template <class Work>
  void offer(bool ghosts, const Work& work) {
    if (ghosts) {
      front_.set_open(cut_.simplices.size());
      from_outside(work);
      front_.set_open(cut_.own);
    } else {
      work();
    }
    for (Index i = 0; i < cut_.simplices.size(); ++i)
      if (front_.reached(i) && front_.waits(i)) front_.queue().note(spread_.rule().distance(i));
  }
  [[nodiscard]] const Rule& rule() const { return spread_.rule(); }
  [[nodiscard]] Front& front() { return front_; }
  /// Of its own triangles.
  [[nodiscard]] std::size_t count_reached() const {
    std::size_t count = 0;
    for (Index i = 0; i < cut_.own; ++i) count += front_.reached(i);
    return count;
  }

  /// Before the first superstep of a run: by the full rule everywhere?
  void set_last_resort(bool last_resort) { last_resort_ = last_resort; }

  /// No label that waits is nearer; +inf if none does.
  [[nodiscard]] Real nearest() const { return front_.queue().nearest(); }

  /// A message to one of its ghosts.
  void take(const Message& message) {
    front_.put(message.to, message.label);
    const Real d = spread_.rule().distance(message.to);
    // Nothing is offered back over the hinge that it came by.
    const unsigned ways = sheet_.leads_in[message.to - cut_.own] & ~(1u << message.hinge);
    if (ways == 0)
      front_.know(message.to, message.hinge, message.label, message.source);
    else
      from_outside(
          [&] { front_.take(message.to, message.hinge, message.label, d, message.source); });
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
    constexpr Real unreached = std::numeric_limits<Real>::infinity();
    Outbox& box = room_.mail.of(superstep);
    Real least = unreached;
    for (Index i = 0; i < cut_.at_cut; ++i) {
      if (!front_.reached(i) || front_.waits(i)) continue;
      const Real d = spread_.rule().distance(i);
      if (!(d < room_.posted[i])) continue;
      room_.posted[i] = d;
      room_.is_new[i] = 1;
      least = std::min(least, d);
    }
    if (!(least < unreached)) return least;
    box.start<Message>(superstep, cut_.peer_count(),
                       [&](std::size_t peer) { return cut_.slots_of(peer).size(); });
    for (std::size_t peer = 0; peer < cut_.peer_count(); ++peer)
      for (const CutPiece::Slot& slot : cut_.slots_of(peer))
        if (room_.is_new[slot.here] != 0)
          box.put(peer,
                  Message{slot.there, front_.source(slot.here),
                          static_cast<Index>(front_.hinge(slot.here)), front_.label(slot.here)});
    std::fill(room_.is_new.begin(), room_.is_new.end(), 0);
    work.messages = box.count();
    return least;
  }

  /// Of its own triangles, without what was given from outside.
  [[nodiscard]] PropagateStatistics statistics() const {
    return {front_.expansions(), front_.updates() - outside_.updates,
            front_.reached_count() - outside_.reached_simplices};
  }

  /// The least distance that its own triangles offer each of their vertices, and of equal ones that
  /// from the first source, into the room.
  void read_out() {
    room_.vertex.assign(sheet_.vertices, std::numeric_limits<Real>::infinity());
    if constexpr (kLabels) room_.vertex_source.assign(sheet_.vertices, none);
    Real* const vertex = room_.vertex.data();
    Index* const owner = room_.vertex_source.data();
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
    const Index end = static_cast<Index>(cut_.own);
    if constexpr (requires { rule.label(0).x; })
      offer_apexes(sheet_.triangles, rule, front, 0, end, offer);
    else
      offer_corners(sheet_.triangles, rule, front, 0, end, offer);
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

  static typename Front::Base base(const CutPiece& cut, TriangleRoom<Real>& room,
                                   const Settings& settings) {
    const std::size_t count = cut.simplices.size();
    room.marks.resize(count + 1);
    room.marks.start();
    room.marks.data()[count] = room.marks.current();
    if constexpr (kLabels) room.source.resize(count + 1);
    room.front.reserve(count);
    return {room.marks,
            room.labels.template reserve<SimplexLabel>(count + 1),
            DualQueue<Real>(room.front, settings.step),
            room.source.data(),
            settings.faces,
            settings.unit,
            *settings.options};
  }

  const CutPiece& cut_;
  TriangleSheet<Real> sheet_;
  TriangleRoom<Real>& room_;
  bool last_resort_ = false;
  Front front_;
  TriangleSpread<Real, Rule, Front> spread_;
  PropagateStatistics outside_;
};

}  // namespace plexway::detail
