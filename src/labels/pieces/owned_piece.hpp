#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

#include <plexway/solve/distance_field.hpp>
#include <plexway/solve/options.hpp>

#include "complexes/partition/cut.hpp"
#include "labels/pieces/mail.hpp"
#include "labels/pieces/owned_front.hpp"

namespace plexway {

/// What a piece keeps from solve to solve where labels are the whole's.
struct OwnedRoom {
  FrontStorage front;
  Outboxes mail;

  [[nodiscard]] std::size_t bytes() const {
    return front.capacity * 2 * sizeof(Index) + mail.box[0].bytes() + mail.box[1].bytes();
  }
};

/// A domain cut so, in pieces of about `size` simplices.
struct OwnedPieces {
  std::uint64_t identity = 0;
  std::size_t size = 0;
  Cut cut;  ///< with the sentinel, which is in no piece
  std::vector<OwnedRoom> rooms;

  [[nodiscard]] std::size_t bytes() const {
    std::size_t sum = cut.bytes() + rooms.capacity() * sizeof(OwnedRoom);
    for (const OwnedRoom& room : rooms) sum += room.bytes();
    return sum;
  }
};

/// A piece of a domain whose rule needs the records around a simplex, and looks at the labels of
/// none but its neighbours: records and labels are the whole's, and a letter is an offer over the
/// cut. Its own labels only this piece reads or writes. Not to be moved.
template <class Real, class SimplexLabel, class Propagation, bool kLabels>
class OwnedPiece {
 public:
  using Number = Real;
  using Front = OwnedFront<Real, SimplexLabel, kLabels>;
  using Letter = typename Front::Letter;
  using Rule = decltype(std::declval<const Propagation&>().rule().on(std::declval<Front&>()));
  using Expander =
      decltype(std::declval<const Propagation&>().expander(std::declval<Front&>(), false));

  OwnedPiece(const OwnedPieces& pieces, Index number, OwnedRoom& room,
             const typename Front::Base& front, const Propagation& propagation)
      : cut_(pieces.cut),
        own_(pieces.cut.pieces[number]),
        room_(room),
        front_(front, pieces.cut.piece_of.data(), number),
        propagation_(propagation),
        rule_(propagation.rule().on(front_)) {
    for (Outbox& box : room.mail.box) box.forget();
  }
  OwnedPiece(const OwnedPiece&) = delete;
  OwnedPiece& operator=(const OwnedPiece&) = delete;

  [[nodiscard]] const CutPiece& cut() const { return own_; }
  [[nodiscard]] Outboxes& mail() { return room_.mail; }
  [[nodiscard]] Real nearest() const { return front_.queue().nearest(); }

  /// A label that waits, from outside the supersteps.
  void give(Index s) {
    const std::size_t updates = front_.updates(), reached = front_.reached_count();
    front_.take(s, front_.hinge(s), front_.label(s), rule_.distance(s), front_.source(s));
    others_.updates += front_.updates() - updates;
    others_.reached_simplices += front_.reached_count() - reached;
  }
  void set_last_resort(bool last_resort) { last_resort_ = last_resort; }

  void take(const Letter& letter) {
    if (letter.distance < to_beat(letter.to))
      front_.take(letter.to, letter.hinge, letter.label, letter.distance, letter.source);
  }

  /// What is nearer than the horizon before comes late: it repeats what was done without it.
  PieceWork run(Real horizon, std::size_t most, std::size_t) {
    PieceWork work;
    const std::size_t before = front_.expansions();
    if (nearest() < horizon_) run_to(std::min(horizon_, horizon), most);
    const std::size_t late = front_.expansions() - before;
    run_to(horizon, most - late);
    horizon_ = std::max(horizon, horizon_);
    work.expansions = front_.expansions() - before;
    work.first = work.expansions - late;
    return work;
  }

  Real post(std::size_t superstep, PieceWork& work) {
    Real least = std::numeric_limits<Real>::infinity();
    std::vector<Letter>& letters = front_.letters();
    if (letters.empty()) return least;
    for (const Letter& letter : letters) least = std::min(least, letter.distance);
    // Peer by peer, each in the order in which they were offered.
    std::stable_sort(letters.begin(), letters.end(), [this](const Letter& a, const Letter& b) {
      return cut_.piece_of[a.to] < cut_.piece_of[b.to];
    });
    Outbox& box = room_.mail.of(superstep);
    box.start<Letter>(superstep, own_.peer_count(), letters.size());
    auto next = letters.begin();
    for (std::size_t peer = 0; peer < own_.peer_count(); ++peer) {
      for (; next != letters.end() && cut_.piece_of[next->to] == own_.peers[peer].piece; ++next)
        box.add(*next);
      box.end_peer();
    }
    letters.clear();
    work.letters = box.count();
    return least;
  }

  [[nodiscard]] PropagateStatistics statistics() const {
    return {front_.expansions(), front_.updates() - others_.updates,
            front_.reached_count() - others_.reached_simplices};
  }

 private:
  [[nodiscard]] Real to_beat(Index s) const {
    if constexpr (requires { rule_.to_beat(s); })
      return rule_.to_beat(s);
    else
      return front_.reached(s) ? rule_.distance(s) : std::numeric_limits<Real>::infinity();
  }

  void run_to(Real horizon, std::size_t most) {
    front_.queue().set_horizon(horizon);
    front_.grant(most);
    Expander expand = propagation_.expander(front_, last_resort_);
    const auto distance_of = [&](Index s) { return rule_.distance(s); };
    for (Index s = 0; front_.next(s, distance_of);) expand(s);
  }

  const Cut& cut_;
  const CutPiece& own_;
  OwnedRoom& room_;
  Front front_;
  const Propagation& propagation_;
  Rule rule_;
  bool last_resort_ = false;
  Real horizon_ = 0;
  PropagateStatistics others_;
};

}  // namespace plexway
