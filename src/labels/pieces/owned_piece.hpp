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
#include "labels/front.hpp"
#include "labels/pieces/mail.hpp"
#include "labels/wavefront.hpp"

namespace plexway {

/// An offer to a simplex of another piece.
template <class Real, class SimplexLabel>
struct OwnedMessage {
  Index to;  ///< the domain's number
  Index source;
  Index hinge;
  Real distance;
  SimplexLabel label;
};

/// The front of a piece that shares the labels of the whole: its own simplices it reads and writes
/// there; what belongs to another piece is as if it were unreached, and offers to it become
/// messages.
template <class Real, class SimplexLabel, bool kLabels>
class OwnedFront : public Wavefront<Real, SimplexLabel, DualQueue<Real>, kLabels> {
 public:
  using Base = Wavefront<Real, SimplexLabel, DualQueue<Real>, kLabels>;
  using typename Base::Label;
  using Message = OwnedMessage<Real, SimplexLabel>;

  /// `piece_of` each simplex; `none` of the sentinel.
  OwnedFront(const Base& base, const Index* piece_of, Index piece)
      : Base(base), piece_of_(piece_of), piece_(piece) {}

  [[nodiscard, gnu::always_inline]] bool reached(Index s) const {
    return (piece_of_[s] == piece_ || piece_of_[s] == none) && Base::reached(s);
  }
  [[gnu::always_inline]] void accept(Index s, std::size_t hinge, const Label& label, Real distance,
                                     Index source) {
    if (piece_of_[s] == piece_) [[likely]]
      Base::accept(s, hinge, label, distance, source);
    else
      messages_.push_back({s, source, static_cast<Index>(hinge), distance, label});
  }

  [[nodiscard]] std::vector<Message>& messages() { return messages_; }

 private:
  const Index* piece_of_;
  Index piece_;
  std::vector<Message> messages_;
};

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
/// none but its neighbours: records and labels are the whole's, and a message is an offer over the
/// cut. Its own labels only this piece reads or writes. Not to be moved.
template <class Real, class SimplexLabel, class Propagation, bool kLabels>
class OwnedPiece {
 public:
  using Number = Real;
  using Front = OwnedFront<Real, SimplexLabel, kLabels>;
  using Message = typename Front::Message;
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

  void take(const Message& message) {
    if (message.distance < to_beat(message.to))
      front_.take(message.to, message.hinge, message.label, message.distance, message.source);
  }

  PieceWork run(Real horizon, std::size_t most, std::size_t) {
    return turns_.run(nearest(), horizon, most, [&](Real until, std::size_t some) {
      const std::size_t before = front_.expansions();
      run_to(until, some);
      return front_.expansions() - before;
    });
  }

  Real post(std::size_t superstep, PieceWork& work) {
    return post_offers<Real>(
        front_.messages(), own_, [this](Index s) { return cut_.piece_of[s]; }, room_.mail,
        superstep, work);
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
  PieceTurns<Real> turns_;
  PropagateStatistics others_;
};

}  // namespace plexway
