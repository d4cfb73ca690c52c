#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

#include <plexway/solve/distance_field.hpp>
#include <plexway/wireframe/wireframe.hpp>

#include "complexes/partition/cut.hpp"
#include "labels/label_memory.hpp"
#include "labels/pieces/mail.hpp"
#include "labels/wireframe/wire_propagation.hpp"

namespace plexway::detail {

/// An offer to a vertex of another piece.
template <class Real>
struct WireMessage {
  Index to, source;
  Real distance;
};

/// What a piece of a wireframe keeps from solve to solve.
template <class Real>
struct WireRoom {
  FrontStorage front;
  std::vector<WireMessage<Real>> messages;  ///< to be posted
  Outboxes mail;

  [[nodiscard]] std::size_t bytes() const {
    return front.capacity * 2 * sizeof(Index) + front.heap.capacity() * sizeof(front.heap[0]) +
           mail.bytes() + messages.capacity() * sizeof(messages[0]);
  }
};

/// A wireframe cut into ranges of its vertices.
template <class Real>
struct WirePieces final : KeptPieces {
  RangeCut cut;
  std::vector<WireRoom<Real>> rooms;

  /// Cost: linear, a quarter of a solve's.
  WirePieces(const Wireframe<Real>& wireframe, std::size_t size, Deal)
      : cut(cut_in_ranges(wireframe.vertex_count(), size,
                          [begin = wireframe.begin().data(), arcs = wireframe.arcs().data()](
                              Index v, const auto& visit) {
                            for (Index k = begin[v]; k < begin[v + 1]; ++k) visit(arcs[k].to);
                          })),
        rooms(cut.cut.pieces.size()) {}

  [[nodiscard]] std::size_t bytes() const override {
    std::size_t sum = cut.cut.bytes() + rooms.capacity() * sizeof(rooms[0]);
    for (const auto& room : rooms) sum += room.bytes();
    return sum;
  }
};

/// A range of a wireframe's vertices. Records and labels are the whole's; its own labels only this
/// piece reads or writes, and what it offers to others is a message. Not to be moved.
template <class Real, bool kLabels>
class WirePiece {
 public:
  using Number = Real;
  using Message = WireMessage<Real>;
  using Spread = WireSpread<Real, kLabels>;

  /// `label` of all vertices; `spread` over them; `step` of the queues; after `patience` looks
  /// nearest first.
  WirePiece(WirePieces<Real>& pieces, Index number, Real* label, const Spread& spread, Real step,
            std::size_t patience)
      : cut_(pieces.cut),
        own_(pieces.cut.cut.pieces[number]),
        begin_(pieces.cut.begin(number)),
        end_(pieces.cut.end(number)),
        room_(pieces.rooms[number]),
        label_(label),
        spread_(spread.anew()),
        front_(prepare(room_, end_ - begin_), step),
        patience_(patience) {
    room_.mail.forget();
    room_.messages.clear();
  }
  WirePiece(const WirePiece&) = delete;
  WirePiece& operator=(const WirePiece&) = delete;

  [[nodiscard]] Outboxes& mail() { return room_.mail; }
  [[nodiscard]] Real nearest() const { return front_.nearest(); }

  /// A label that waits, from outside the supersteps.
  void give(Index v) { front_.push(v, std::abs(label_[v])); }

  void take(const Message& message) {
    spread_.offer(message.to, message.distance, message.source, front_);
  }

  PieceWork run(Real horizon, std::size_t most, std::size_t) {
    const PieceWork work = turns_.run(nearest(), horizon, most, [&](Real until, std::size_t some) {
      std::size_t left = some;
      run_to(until, left);
      return some - left;
    });
    expansions_ += work.expansions;
    return work;
  }

  Real post(std::size_t superstep, PieceWork& work) {
    return post_offers<Real>(
        room_.messages, own_, [this](Index v) { return cut_.piece_of(v); }, room_.mail, superstep,
        work);
  }

  [[nodiscard]] PropagateStatistics statistics() const {
    return {expansions_, spread_.updates(), spread_.reached()};
  }

 private:
  static FrontStorage& prepare(WireRoom<Real>& room, std::size_t own) {
    room.front.reserve(own);
    return room.front;
  }

  struct Where {
    WirePiece& piece;
    Index begin, count;
    [[nodiscard]] bool has(Index v) const { return v - begin < count; }
    void tell(Index to, Real distance, Index source) const {
      piece.room_.messages.push_back({to, source, distance});
    }
  };

  void run_to(Real horizon, std::size_t& left) {
    front_.set_horizon(horizon);
    const Where where{*this, begin_, end_ - begin_};
    // Out of its share: it waits on.
    const auto more = [&](auto& front) {
      return [&front](Index v, Real distance) {
        front.push(v, distance, true);
        return false;
      };
    };
    if (!front_.sorted()) {
      DualQueue<Real> queue = front_.dual();
      const bool quiet = spread_.run(queue, where, left, patience_, more(queue));
      front_.dual() = queue;
      patience_ -= std::min(patience_, spread_.looks());
      if (quiet) return;
      front_.sort();
      for (Index v = begin_; v < end_; ++v)
        if (std::signbit(label_[v])) front_.push(v, -label_[v]);
    }
    spread_.run(front_, where, left, std::numeric_limits<std::size_t>::max(), more(front_));
  }

  const RangeCut& cut_;
  const CutPiece& own_;
  Index begin_, end_;
  WireRoom<Real>& room_;
  Real* label_;
  Spread spread_;
  WireFront<Real> front_;
  std::size_t patience_;
  PieceTurns<Real> turns_;
  std::size_t expansions_ = 0;
};

}  // namespace plexway::detail
