#pragma once

#include <array>
#include <cstddef>
#include <limits>

#include "executors/parts/part_distances.hpp"
#include "executors/parts/part_pieces.hpp"
#include "executors/parts/part_sources.hpp"
#include "windows/window_piece.hpp"

namespace plexway::detail {

/// Windows on a surface in parts: the pieces of this process. As windows::PiecedWindows, but that
/// nobody looks at the whole.
template <class Real, class Windows>
class PartedWindows {
 public:
  using Number = typename Windows::Number;
  using Piece = windows::WindowPiece<Real, Windows>;

  /// `pieces` must outlive this.
  explicit PartedWindows(const PartPieces<Real>& pieces)
      : pieces_(pieces), windows_(pieces.deal()) {
    for (const PartPiece<Real>& part : pieces.parts())
      windows_.add(pieces.sheet(part), pieces.cut_of(part), part.addresses, part.number);
  }
  PartedWindows(const PartedWindows&) = delete;
  PartedWindows& operator=(const PartedWindows&) = delete;

  /// As Windows::solve. `scheduler` as PiecedWindows has it.
  template <class Scheduler>
  [[nodiscard]] bool solve(const Scheduler& scheduler, const PartSources& sources,
                           const PropagateOptions& options, const typename Windows::Limit& limit) {
    labels_ = sources.all.size() > 1;
    statistics_ = {};
    const windows::WindowSources all(sources.all);
    scheduler.each(windows_.size(), [&](std::size_t i) {
      windows_[i].begin(all, options, limit);
      seed(i, sources.here[i]);
    });
    const bool is_bounded = options.radius < std::numeric_limits<double>::infinity();
    bool too_many = false;
    const auto goes_on = [&](std::size_t expansions, std::size_t waiting) {
      too_many = windows::is_too_much<Windows>(windows_, pieces_.summary().faces, expansions,
                                               waiting, limit);
      return !too_many;
    };
    do {
      complete_ =
          scheduler.run(pieces_.cut(), windows_, pieces_.summary().faces, statistics_, goes_on);
      if (too_many) return false;
    } while (complete_ && !is_bounded && fill_holes(scheduler));
    return true;
  }

  /// What our piece i knows. Pieces may differ where a radius or a budget ended the exchange.
  [[nodiscard]] PartDistances<Number> known(std::size_t i) const {
    const Windows& windows = windows_[i].windows();
    const std::size_t count = pieces_.parts()[i].vertices.size();
    PartDistances<Number> known;
    known.distance.resize(count);
    known.error.resize(count);
    known.source.resize(labels_ ? count : 0);
    for (Index v = 0; v < count; ++v) {
      known.distance[v] = windows.vertex_distance(v);
      known.error[v] = windows.vertex_error(v);
      if (labels_) known.source[v] = windows.source(v);
    }
    return known;
  }
  [[nodiscard]] bool complete() const { return complete_; }
  [[nodiscard]] const PropagateStatistics& statistics() const { return statistics_; }
  [[nodiscard]] std::size_t bytes() const {
    std::size_t sum = 0;
    for (const Piece& piece : windows_) sum += piece.bytes();
    return sum;
  }

 private:
  void seed(std::size_t i, const PartSources::Here& here) {
    const PartPiece<Real>& part = pieces_.parts()[i];
    Windows& windows = windows_[i].windows();
    windows::WindowSources sources(here.points);
    sources.numbers = here.numbers;
    windows::for_each_seed(
        *part.mesh, sources,
        [&](Index v, double sigma, Index n) {
          if (v < part.vertices.size()) windows.seed_vertex(v, sigma, n);
        },
        [&](Index f, const std::array<double, 4>& b, double sigma, Index n) {
          Windows::for_each_place(part.mesh->triangles(), f, b,
                                  [&](Index g, const std::array<double, 4>& there) {
                                    if (g < part.own) windows.seed_inside(g, there, sigma, n);
                                  });
        });
  }

  /// Each in its piece; the others hear of it by messages.
  template <class Scheduler>
  bool fill_holes(const Scheduler& scheduler) {
    return scheduler.any(windows_.size(), [&](std::size_t i) {
      const PartPiece<Real>& part = pieces_.parts()[i];
      Windows& windows = windows_[i].windows();
      bool all = true;  // usual: no look at edges
      for (Index v = 0; v < part.vertices.size(); ++v)
        all &= windows.vertex_distance(v) < std::numeric_limits<Number>::infinity();
      return !all && Windows::fill_holes(
                         part.mesh->triangles(), static_cast<Index>(part.own),
                         [&](Index v) { return windows.vertex_distance(v); },
                         [&](Index v, Index w, Number way) {
                           windows.seed_hole(w, way, windows.source(v), windows.vertex_error(v));
                         });
    });
  }

  const PartPieces<Real>& pieces_;
  OurPieces<Piece> windows_;
  bool labels_ = false, complete_ = true;
  PropagateStatistics statistics_;
};

}  // namespace plexway::detail
