#pragma once

#include <algorithm>
#include <cstddef>
#include <limits>
#include <utility>
#include <vector>

#include <plexway/solve/distance_field.hpp>

#include "labels/pieces/mail.hpp"
#include "windows/messages.hpp"
#include "windows/window_patches.hpp"

namespace plexway::detail::windows {
/// A piece of a surface in solves by windows, exact or merged: what Supersteps asks of one.
/// Messages are windows that enter a ghost, for the piece that it belongs to, and vertices that got
/// nearer, for all that have them; each then goes around a vertex, and lights up its own triangles.
template <class Real, class Windows>
class WindowPiece {
 public:
  using Number = double;
  using Message = windows::Message<typename Windows::Number>;

  /// All of which must outlive this.
  WindowPiece(const Sheet<Real>& sheet, const CutPiece& cut, const PatchAddresses& addresses,
              Index number)
      : cut_(&cut), addresses_(&addresses), number_(number), windows_(sheet) {}
  WindowPiece(const WindowPatches<Real>& patches, Index number)
      : WindowPiece(patches.sheet(number), patches.cut().pieces[number], patches[number].addresses,
                    number) {}

  [[nodiscard]] Windows& windows() { return windows_; }
  [[nodiscard]] const Windows& windows() const { return windows_; }

  void begin(const WindowSources& sources, const PropagateOptions& options,
             const typename Windows::Limit& limit) {
    windows_.begin(sources, options, limit);
    mail_.forget();
    turns_ = {};
  }

  [[nodiscard]] Index number() const { return number_; }
  [[nodiscard]] Outboxes& mail() { return mail_; }
  /// Of what waits here, or leaves: where a source's triangle has none but ghosts around it, all
  /// that it sends out leaves.
  [[nodiscard]] double nearest() const {
    double least = windows_.nearest();
    const auto& leaving = std::as_const(windows_).leaving();
    for (const Message& message : leaving.windows)
      least = std::min(least, static_cast<double>(Windows::turn_of(message.window)));
    for (const Index v : leaving.vertices)
      least = std::min(least, static_cast<double>(windows_.vertex_distance(v)));
    return least;
  }
  [[nodiscard]] PropagateStatistics statistics() const { return windows_.statistics(); }
  /// Windows that take room.
  [[nodiscard]] std::size_t weight() const {
    if constexpr (requires { windows_.most_waiting(); })
      return windows_.most_waiting();
    else
      return 0;
  }

  void take(const Message& message) { windows_.take(message); }

  PieceWork run(double horizon, std::size_t most, std::size_t) {
    return turns_.run(windows_.nearest(), horizon, most, [&](double until, std::size_t some) {
      const std::size_t before = windows_.statistics().expansions;
      windows_.run_to(until, some);
      return windows_.statistics().expansions - before;
    });
  }

  double post(std::size_t superstep, PieceWork& work) {
    Leaving<typename Windows::Number>& leaving = windows_.leaving();
    double least = std::numeric_limits<double>::infinity();
    if (leaving.windows.empty() && leaving.vertices.empty()) return least;
    const CutPiece& own = *cut_;
    const PatchAddresses& addresses = *addresses_;
    const auto home = [&](const Message& message) {
      return addresses.at_home[(message.to >> 2) - own.own];
    };
    // What a message has told since was told to all by who wrote it.
    leaving.leave_out([&](Index v) {
      const Index corner = windows_.arrival(v).corner;
      return corner != none && (corner & ~Windows::corner_flags) / 3 >= own.own;
    });
    counts_.assign(own.peer_count(), 0);
    for (const Message& message : leaving.windows) ++counts_[home(message).piece];
    for (const Index v : leaving.vertices)
      for (const auto& place : addresses.vertices.of(v)) ++counts_[place.piece];
    Outbox& box = mail_.of(superstep);
    box.start<Message>(superstep, counts_.size(), [&](std::size_t peer) { return counts_[peer]; });
    for (Message& message : leaving.windows) {
      least = std::min(least, static_cast<double>(Windows::turn_of(message.window)));
      const auto [peer, f] = home(message);
      message.to = f << 2 | (message.to & 3);
      box.put(peer, message);
    }
    for (const Index v : leaving.vertices) {
      if (addresses.vertices.of(v).empty()) continue;
      const auto distance = windows_.vertex_distance(v);
      least = std::min(least, static_cast<double>(distance));
      const auto arrival = windows_.arrival(v);
      for (const auto& [peer, number] : addresses.vertices.of(v)) {
        auto there = arrival;
        there.corner = corner_elsewhere(arrival.corner, peer);
        box.put(peer, Message::of_vertex(number, distance, there, windows_.source(v),
                                         windows_.vertex_error(v)));
      }
    }
    leaving.clear();
    work.messages = box.count();
    return least;
  }

  [[nodiscard]] std::size_t bytes() const {
    return windows_.bytes() + mail_.bytes() + counts_.capacity() * sizeof(counts_[0]);
  }

 private:
  /// A corner of this piece's triangles by the numbers of a peer that has the vertex there, to
  /// which the triangle is a ghost.
  [[nodiscard]] Index corner_elsewhere(Index corner, Index peer) const {
    if (corner == none) return none;
    const Index flags = corner & Windows::corner_flags, c = corner & ~Windows::corner_flags;
    for (const auto& [other, f] : addresses_->triangles.of(c / 3))
      if (other == peer) return (3 * f + c % 3) | flags;
    return none;  // not reached: who has the vertex has what lies around it
  }

  const CutPiece* cut_;
  const PatchAddresses* addresses_;
  Index number_;
  Windows windows_;
  Outboxes mail_;
  std::vector<std::size_t> counts_;  ///< messages to each peer
  PieceTurns<double> turns_;
};

/// Between supersteps of `pieces` on so many triangles: is it too much to wait for? Ends ties where
/// it takes long.
template <class Windows, class Pieces>
[[nodiscard]] bool is_too_much(Pieces& pieces, std::size_t triangles, std::size_t expansions,
                               [[maybe_unused]] std::size_t waiting,
                               [[maybe_unused]] const typename Windows::Limit& limit) {
  if constexpr (requires { limit.waiting; }) {
    if (Windows::ties_end(expansions, triangles))
      for (auto& piece : pieces) piece.windows().end_ties();
    return expansions > limit.windows || waiting > limit.waiting;
  } else {
    return Windows::too_many(expansions, triangles);
  }
}

}  // namespace plexway::detail::windows
