#pragma once

#include <array>
#include <cstddef>
#include <limits>
#include <span>
#include <vector>

#include <plexway/solve/distance_field.hpp>
#include <plexway/solve/options.hpp>
#include <plexway/surface/triangle_mesh.hpp>

#include "windows/window_patches.hpp"
#include "windows/window_piece.hpp"

namespace plexway::detail::windows {
/// Windows on a surface in pieces, with what ExactWindows and MergedWindows tell after a solve.
template <class Real, class Windows>
class PiecedWindows {
 public:
  using Piece = WindowPiece<Real, Windows>;
  using Number = typename Windows::Number;

  /// `patches` and what they refer to must outlive this.
  PiecedWindows(const TriangleMesh<Real>& mesh, const WindowPatches<Real>& patches)
      : mesh_(mesh), patches_(patches), pieces_(patches.deal()) {
    patches.deal().each(patches.count(),
                        [&](std::size_t p) { pieces_.add(patches, static_cast<Index>(p)); });
  }
  PiecedWindows(const PiecedWindows&) = delete;
  PiecedWindows& operator=(const PiecedWindows&) = delete;

  /// As Windows::solve, from points alone. The scheduler does the work: scheduler.run(cut, pieces,
  /// triangles, statistics, goes_on) until no window waits (true) or there is a reason to stop,
  /// scheduler.each(count, work), and for processes that share the pieces scheduler.share and
  /// scheduler.any.
  template <class Scheduler>
  [[nodiscard]] bool solve(const Scheduler& scheduler, const WindowSources& sources,
                           const PropagateOptions& options, const typename Windows::Limit& limit) {
    labels_ = sources.labels;
    statistics_ = {};
    complete_ = true;
    scheduler.each(pieces_.size(),
                   [&](std::size_t p) { pieces_[p].begin(sources, options, limit); });
    for_each_seed(
        mesh_, sources,
        [&](Index v, double sigma, Index n) {
          for (const auto& place : patches_.places(v))
            if (Piece* const piece = pieces_.find(place.piece))
              piece->windows().seed_vertex(place.number, sigma, n);
        },
        [&](Index f, const std::array<double, 4>& b, double sigma, Index n) {
          const Cut& cut = patches_.cut();
          Windows::for_each_place(
              mesh_.triangles(), f, b, [&](Index g, const std::array<double, 4>& there) {
                if (Piece* const piece = pieces_.find(cut.piece_of[g]))
                  piece->windows().seed_inside(cut.number_of[g], there, sigma, n);
              });
        });
    const bool is_bounded = options.radius < std::numeric_limits<double>::infinity();
    bool too_many = false;
    const auto goes_on = [&](std::size_t expansions, std::size_t waiting) {
      too_many = is_too_much<Windows>(pieces_, mesh_.face_count(), expansions, waiting, limit);
      return !too_many;
    };
    do {
      complete_ = scheduler.run(patches_.cut(), pieces_, mesh_.face_count(), statistics_, goes_on);
      if (too_many) return false;
      gather(scheduler, is_bounded);
    } while (complete_ && !is_bounded && fill_holes(scheduler));
    return true;
  }

  [[nodiscard]] Number distance(Index vertex) const { return distance_[vertex]; }
  [[nodiscard]] Index source(Index vertex) const { return labels_ ? source_[vertex] : 0; }
  [[nodiscard]] Number error(Index vertex) const { return error_[vertex]; }
  [[nodiscard]] bool complete() const { return complete_; }
  [[nodiscard]] const PropagateStatistics& statistics() const { return statistics_; }
  [[nodiscard]] std::size_t bytes() const {
    std::size_t sum = (distance_.capacity() + error_.capacity()) * sizeof(Number) +
                      source_.capacity() * sizeof(Index);
    for (const Piece& piece : pieces_) sum += piece.bytes();
    return sum;
  }

 private:
  /// Of a vertex.
  struct Known {
    Number distance, error;
    Index source;
  };

  template <class Scheduler>
  void gather(const Scheduler& scheduler, bool is_bounded) {
    constexpr Number unreached = std::numeric_limits<Number>::infinity();
    const std::size_t vertices = mesh_.vertex_count();
    distance_.assign(vertices, unreached);
    error_.resize(vertices);
    if (labels_) source_.resize(vertices);
    const auto take = [&](Index v, const Known& known) {
      distance_[v] = known.distance;
      error_[v] = known.error;
      if (labels_) source_[v] = known.source;
    };
    const auto known_of = [&](std::size_t p, Index i) {
      const Windows& windows = pieces_.find(p)->windows();
      return Known{windows.vertex_distance(i), windows.vertex_error(i),
                   labels_ ? windows.source(i) : none};
    };
    // Pieces differ where the radius or the budget ended the exchange, and in whose equal way they
    // keep: the first's, or that of the first source.
    const bool agree = complete_ && !is_bounded && !labels_;
    const auto is_first = [&](std::size_t p, Index v) { return patches_.places(v)[0].piece == p; };
    scheduler.each(pieces_.size(), [&](std::size_t k) {
      const std::size_t p = pieces_[k].number();
      const auto& patch = patches_[p];
      for (std::size_t i = 0; i < patch.shared; ++i)
        if (agree && is_first(p, patch.vertices[i]))
          take(patch.vertices[i], known_of(p, static_cast<Index>(i)));
      for (std::size_t i = patch.shared; i < patch.vertices.size(); ++i)
        take(patch.vertices[i], known_of(p, static_cast<Index>(i)));
    });
    std::vector<std::vector<Known>> others(patches_.count());
    scheduler.share(
        patches_.count(),
        [&](std::size_t p, auto& parcel) {
          for (Index i = 0; i < patches_[p].vertices.size(); ++i) parcel.add(known_of(p, i));
        },
        [&](std::size_t p, auto mail) {
          const auto& patch = patches_[p];
          for (Index i = 0; i < patch.shared; ++i) {
            const Known known = mail.template take<Known>();
            if (!agree)
              others[p].push_back(known);
            else if (is_first(p, patch.vertices[i]))
              take(patch.vertices[i], known);
          }
          for (std::size_t i = patch.shared; i < patch.vertices.size(); ++i)
            take(patch.vertices[i], mail.template take<Known>());
        });
    if (agree) return;
    for (std::size_t p = 0; p < patches_.count(); ++p) {
      const auto& patch = patches_[p];
      for (Index i = 0; i < patch.shared; ++i) {
        const Index v = patch.vertices[i];
        const Known known = patches_.deal().is_ours(p) ? known_of(p, i) : others[p][i];
        const Number d = known.distance;
        if (d < distance_[v] ||
            (labels_ && d == distance_[v] && d < unreached && known.source < source_[v]))
          take(v, known);
      }
    }
  }

  /// As one thread would, on the whole; if there is anything at all.
  template <class Scheduler>
  bool fill_holes(const Scheduler& scheduler) {
    const bool any = scheduler.any(pieces_.size(), [&](std::size_t k) {
      const Windows& windows = pieces_[k].windows();
      const std::size_t p = pieces_[k].number();
      bool all = true;  // usual: no look at edges
      for (Index i = 0; i < patches_[p].vertices.size(); ++i)
        all &= windows.vertex_distance(i) < std::numeric_limits<Number>::infinity();
      return !all &&
             Windows::fill_holes(
                 std::span<const TriangleRecord<Real>>(patches_[p].triangles),
                 static_cast<Index>(patches_.cut().pieces[p].own),
                 [&](Index v) { return windows.vertex_distance(v); }, [](Index, Index, Number) {});
    });
    if (!any) return false;
    return Windows::fill_holes(
        mesh_.triangles(), static_cast<Index>(mesh_.face_count()),
        [&](Index v) { return distance_[v]; },
        [&](Index v, Index w, Number way) {
          distance_[w] = way;
          error_[w] = error_[v];
          if (labels_) source_[w] = source_[v];
          for (const auto& place : patches_.places(w))
            if (Piece* const piece = pieces_.find(place.piece))
              piece->windows().seed_hole(place.number, way, source(v), error_[v]);
        });
  }

  const TriangleMesh<Real>& mesh_;
  const WindowPatches<Real>& patches_;
  OurPieces<Piece> pieces_;
  bool labels_ = false, complete_ = true;
  PropagateStatistics statistics_;
  std::vector<Number> distance_, error_;
  std::vector<Index> source_;
};

}  // namespace plexway::detail::windows
