#pragma once

#include <algorithm>
#include <cstddef>
#include <limits>
#include <span>
#include <vector>

#include <plexway/propagate/distance_field.hpp>

#include "propagate/pieces/mail.hpp"
#include "propagate/windows/letters.hpp"
#include "propagate/windows/window_patches.hpp"

namespace plexway::windows {

/// A piece of a surface in solves by windows, exact or merged: what Supersteps asks of one. Letters
/// are windows that enter a ghost, for the piece that it belongs to, and vertices that got nearer,
/// for all that have them; each then goes around a vertex, and lights up its own triangles.
template <class Real, class Windows>
class WindowPiece {
 public:
  using Number = double;
  using Letter = windows::Letter<typename Windows::Number>;

  /// `patches` must outlive this.
  WindowPiece(const WindowPatches<Real>& patches, Index number)
      : patches_(&patches), number_(number), windows_(patches.sheet(number)) {}

  [[nodiscard]] Windows& windows() { return windows_; }
  [[nodiscard]] const Windows& windows() const { return windows_; }

  void begin(const WindowSources& sources, const PropagateOptions& options,
             const typename Windows::Limit& limit) {
    windows_.begin(sources, options, limit);
    for (Outbox& box : mail_.box) box.forget();
    horizon_ = 0;
  }

  [[nodiscard]] Index number() const { return number_; }
  [[nodiscard]] const CutPiece& cut() const { return patches_->cut().pieces[number_]; }
  [[nodiscard]] Outboxes& mail() { return mail_; }
  [[nodiscard]] double nearest() const { return windows_.nearest(); }
  [[nodiscard]] PropagateStatistics statistics() const { return windows_.statistics(); }
  /// Windows that take room.
  [[nodiscard]] std::size_t weight() const {
    if constexpr (requires { windows_.most_waiting(); })
      return windows_.most_waiting();
    else
      return 0;
  }

  void take(Letter letter) {
    if (letter.tells_of_vertex() && letter.corner != none) {
      // In a triangle of the other piece, which is a ghost here since it has the vertex.
      const Index corner = letter.corner & ~Windows::corner_flags;
      const Index f = cut().ghost(corner / 3, patches_->cut().piece_of);
      letter.corner = (3 * f + corner % 3) | (letter.corner & Windows::corner_flags);
    }
    windows_.take(letter);
  }

  /// What is nearer than the horizon before comes late: it repeats what was done without it.
  PieceWork run(double horizon, std::size_t most, std::size_t) {
    PieceWork work;
    const std::size_t before = windows_.statistics().expansions;
    const auto done = [&] { return windows_.statistics().expansions - before; };
    if (windows_.nearest() < horizon_) windows_.run_to(std::min(horizon_, horizon), most);
    const std::size_t late = done();
    windows_.run_to(horizon, most - late);
    horizon_ = std::max(horizon, horizon_);
    work.expansions = done();
    work.first = work.expansions - late;
    return work;
  }

  double post(std::size_t superstep, PieceWork& work) {
    Leaving<typename Windows::Number>& leaving = windows_.leaving();
    const Cut& cut = patches_->cut();
    const CutPiece& own = cut.pieces[number_];
    double least = std::numeric_limits<double>::infinity();
    if (leaving.windows.empty() && leaving.vertices.empty()) return least;
    out_.clear();
    for (Letter letter : leaving.windows) {
      const Index ghost = own.simplices[letter.to >> 2];
      least = std::min(least, static_cast<double>(Windows::turn_of(letter.window)));
      letter.to = cut.number_of[ghost] << 2 | (letter.to & 3);
      out_.push_back({own.place_of(cut.piece_of[ghost]), letter});
    }
    const auto& patch = (*patches_)[number_];
    for (const Index v : leaving.vertices) {
      const auto distance = windows_.vertex_distance(v);
      least = std::min(least, static_cast<double>(distance));
      auto arrival = windows_.arrival(v);
      if (arrival.corner != none) {
        const Index corner = arrival.corner & ~Windows::corner_flags;
        arrival.corner =
            (3 * own.simplices[corner / 3] + corner % 3) | (arrival.corner & Windows::corner_flags);
      }
      for (const auto& place : patches_->places(patch.vertices[v]))
        if (place.piece != number_)
          out_.push_back({own.place_of(place.piece),
                          Letter::of_vertex(place.number, distance, arrival, windows_.source(v),
                                            windows_.vertex_error(v))});
    }
    leaving.clear();
    std::stable_sort(out_.begin(), out_.end(),
                     [](const Posted& a, const Posted& b) { return a.peer < b.peer; });
    Outbox& box = mail_.of(superstep);
    box.start<Letter>(superstep, own.peer_count(), out_.size());
    auto next = out_.begin();
    for (std::size_t peer = 0; peer < own.peer_count(); ++peer) {
      for (; next != out_.end() && next->peer == peer; ++next) box.add(next->letter);
      box.end_peer();
    }
    work.letters = box.count();
    return least;
  }

  [[nodiscard]] std::size_t bytes() const {
    return windows_.bytes() + mail_.box[0].bytes() + mail_.box[1].bytes() +
           out_.capacity() * sizeof(Posted);
  }

 private:
  struct Posted {
    std::size_t peer;
    Letter letter;
  };

  const WindowPatches<Real>* patches_;
  Index number_;
  Windows windows_;
  Outboxes mail_;
  std::vector<Posted> out_;
  double horizon_ = 0;  ///< of the superstep before
};

}  // namespace plexway::windows
