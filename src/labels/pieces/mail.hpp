#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <type_traits>
#include <vector>

#include <plexway/common/ids.hpp>
#include <plexway/surface/triangle_mesh.hpp>

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

/// The triangles of a piece by its numbers: its own, ghosts, and a sentinel. keeps(f, e): is all
/// that lies around edge e of a ghost f here? Its other edges are made boundaries.
template <class Real, class Keeps>
[[nodiscard]] std::vector<TriangleRecord<Real>> piece_records(const TriangleMesh<Real>& mesh,
                                                              const Cut& cut, Index number,
                                                              const Keeps& keeps) {
  const CutPiece& piece = cut.pieces[number];
  const auto records = mesh.triangles();
  const Index sentinel = static_cast<Index>(mesh.face_count());
  const Index end = static_cast<Index>(piece.simplices.size());
  constexpr Index rest = (Index{1} << Across::face_shift) - 1;
  std::vector<TriangleRecord<Real>> found(piece.simplices.size() + 1);
  const auto here = [&](Index g) {
    if (g == sentinel) return none;
    return cut.piece_of[g] == number ? cut.number_of[g] : piece.ghost(g, cut.piece_of);
  };
  for (Index i = 0; i < end; ++i) {
    const Index f = piece.simplices[i];
    TriangleRecord<Real>& t = found[i];
    t = records[f];
    for (std::size_t e = 0; e < 3; ++e) {
      const bool kept = i < piece.own || keeps(f, e);
      const Index g = kept ? here(t.across[e] >> Across::face_shift) : none;
      t.across[e] =
          g == none ? end << Across::face_shift : g << Across::face_shift | (t.across[e] & rest);
    }
  }
  found[end] = records[sentinel];
  for (Index& across : found[end].across)
    if (across >> Across::face_shift == sentinel)
      across = end << Across::face_shift | (across & rest);
  return found;
}

/// Numbers the vertices of each patch's own triangles anew, first those that other patches have as
/// well, and puts the numbers into its records, where it has any; ghosts get none. Patches have
/// `triangles`, `vertices` (of each number the surface's) and `shared` (so many are others', too).
template <class Real, class Patches>
void number_vertices(const TriangleMesh<Real>& mesh, const Cut& cut, Patches& patches) {
  const std::size_t vertices = mesh.vertex_count();
  const auto records = mesh.triangles();
  std::vector<Index> piece(vertices, none), number(vertices);
  std::vector<std::uint8_t> is_shared(vertices, 0);
  for (std::size_t f = 0; f < mesh.face_count(); ++f)
    for (const Index v : records[f].corner) {
      if (piece[v] == none) piece[v] = cut.piece_of[f];
      if (piece[v] != cut.piece_of[f]) is_shared[v] = 1;
    }
  piece.assign(vertices, none);
  for (Index p = 0; p < patches.size(); ++p) {
    auto& patch = patches[p];
    const std::span own = std::span(cut.pieces[p].simplices).first(cut.pieces[p].own);
    patch.vertices.reserve(own.size() / 2 + own.size() / 8 + 8);
    for (const bool wanted : {true, false}) {
      for (const Index f : own)
        for (const Index v : records[f].corner)
          if ((is_shared[v] != 0) == wanted && piece[v] != p) {
            piece[v] = p;
            number[v] = static_cast<Index>(patch.vertices.size());
            patch.vertices.push_back(v);
          }
      if (wanted) patch.shared = patch.vertices.size();
    }
    for (std::size_t i = 0; i < patch.triangles.size(); ++i)
      for (Index& v : patch.triangles[i].corner) v = i < own.size() ? number[v] : none;
  }
}

}  // namespace plexway::detail
