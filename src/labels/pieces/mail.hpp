#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <type_traits>
#include <vector>

#include <plexway/common/ids.hpp>

#include "complexes/partition/cut.hpp"
#include "labels/label_memory.hpp"

namespace plexway::detail {

/// What a piece posts in one superstep, peer by peer. Plain data, so that it may as well be sent.
class Outbox {
 public:
  /// Empty, with room for room_of(peer) messages to each of so many peers.
  template <class Message, class RoomOf>
  void start(std::size_t superstep, std::size_t peers, const RoomOf& room_of) {
    static_assert(std::is_trivially_copyable_v<Message>);
    superstep_ = superstep;
    count_ = 0;
    begin_.resize(peers);
    std::size_t room = 0;
    for (std::size_t peer = 0; peer < peers; ++peer) {
      begin_[peer] = room;
      room += room_of(peer);
    }
    end_.assign(begin_.begin(), begin_.end());
    messages_.reserve<Message>(room);
  }
  /// One more to that peer, behind those that it has.
  template <class Message>
  void put(std::size_t peer, const Message& message) {
    messages_.reserve<Message>(0)[end_[peer]++] = message;
    ++count_;
  }
  /// There are none in any other superstep.
  void forget() { superstep_ = never; }

  template <class Message>
  [[nodiscard]] std::span<const Message> messages(std::size_t superstep, std::size_t peer) {
    if (superstep != superstep_) return {};
    return {messages_.reserve<Message>(0) + begin_[peer], end_[peer] - begin_[peer]};
  }
  [[nodiscard]] std::size_t count() const { return count_; }
  [[nodiscard]] std::size_t bytes() const {
    return messages_.bytes() + (begin_.capacity() + end_.capacity()) * sizeof(std::size_t);
  }

 private:
  static constexpr std::size_t never = std::numeric_limits<std::size_t>::max();
  Room messages_;
  std::vector<std::size_t> begin_, end_;
  std::size_t superstep_ = never, count_ = 0;
};

/// A piece's messages of this superstep and of the one before: nobody reads what somebody writes.
struct Outboxes {
  Outbox box[2];

  [[nodiscard]] Outbox& of(std::size_t superstep) { return box[superstep % 2]; }
  /// Before a solve.
  void forget() {
    for (Outbox& one : box) one.forget();
  }
  [[nodiscard]] std::size_t bytes() const { return box[0].bytes() + box[1].bytes(); }
};

/// What a piece did in a superstep.
struct PieceWork {
  std::size_t expansions = 0;
  std::size_t first = 0;  ///< simplices reached that no label had reached before
  std::size_t messages = 0;
};

/// A piece's turns, one horizon after the other.
template <class Real>
class PieceTurns {
 public:
  /// run_to(horizon, most) returns how many expansions it made. What is nearer than the horizon
  /// before comes late: it repeats what was done without it.
  template <class RunTo>
  PieceWork run(Real nearest, Real horizon, std::size_t most, const RunTo& run_to) {
    PieceWork work;
    const std::size_t late = nearest < before_ ? run_to(std::min(before_, horizon), most) : 0;
    work.first = run_to(horizon, most - late);
    work.expansions = late + work.first;
    before_ = std::max(before_, horizon);
    return work;
  }

 private:
  Real before_ = 0;
};

/// Posts offers to simplices of other pieces: peer by peer, each in the order in which they were
/// made. None is left. Returns the least of their distances.
template <class Real, class Message, class PieceOf>
Real post_offers(std::vector<Message>& messages, const CutPiece& piece, const PieceOf& piece_of,
                 Outboxes& mail, std::size_t superstep, PieceWork& work) {
  Real least = std::numeric_limits<Real>::infinity();
  work.messages = messages.size();
  if (messages.empty()) return least;
  std::size_t place = 0;  // often that of the one before
  const auto peer_of = [&](const Message& message) {
    const auto other = static_cast<Index>(piece_of(message.to));
    if (piece.peers[place].piece != other) place = piece.place_of(other);
    return place;
  };
  std::vector<std::size_t> counts(piece.peer_count(), 0);
  for (const Message& message : messages) ++counts[peer_of(message)];
  Outbox& box = mail.of(superstep);
  box.start<Message>(superstep, counts.size(), [&](std::size_t peer) { return counts[peer]; });
  for (const Message& message : messages) {
    least = std::min(least, message.distance);
    box.put(peer_of(message), message);
  }
  messages.clear();
  return least;
}

}  // namespace plexway::detail
