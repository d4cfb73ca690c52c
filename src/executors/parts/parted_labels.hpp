#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <span>
#include <tuple>
#include <utility>
#include <vector>

#include "executors/parts/part_distances.hpp"
#include "executors/parts/part_label_rooms.hpp"
#include "executors/parts/part_sources.hpp"
#include "executors/solve_surface.hpp"
#include "executors/threads/piece_scheduler.hpp"
#include "executors/threads/supersteps.hpp"
#include "labels/front.hpp"
#include "labels/pieces/triangle_piece.hpp"
#include "labels/surface/triangle_propagation.hpp"

namespace plexway::detail {

/// Visibility::saddles, for the front of any piece.
template <class Real>
struct SaddlesInParts {
  using Label = SaddleLabel<Real>;
  bool vectorised;
  template <class Front>
  [[nodiscard]] SaddleRule<Real, Front> over(std::span<const TriangleRecord<Real>> triangles,
                                             Front& front) const {
    return SaddleRule<Real, Front>(triangles, front, vectorised);
  }
};

/// The other policies.
template <class Real>
struct PlainInParts {
  using Label = SimplexLabel<Real, 2>;
  ProbeAim<Real> aim;
  template <class Front>
  [[nodiscard]] PlainRule<Real, Front> over(std::span<const TriangleRecord<Real>> triangles,
                                            Front& front) const {
    return PlainRule<Real, Front>(triangles, front, aim);
  }
};

/// One solve by labels on a surface in parts: the pieces of this process. As surface::solve by a
/// PieceScheduler, but that nobody looks at the whole: who has a seed, a vertex where fans touch or
/// a triangle beside an unreached one does there what would be done on the whole. All processes
/// call everything here.
template <class Real, class Like, bool kLabels>
class PartedLabels {
 public:
  using Label = typename Like::Label;

  /// All must outlive this.
  PartedLabels(const Team& team, const PartPieces<Real>& pieces, PartLabelRooms<Real>& rooms,
               const Like& like, const PartSources& sources, const PropagateOptions& options,
               SuperstepCounts& counts)
      : team_(team),
        pieces_(pieces),
        rooms_(rooms),
        sources_(sources),
        options_(options),
        counts_(counts),
        radius_(static_cast<Real>(options.radius / pieces.unit())),
        labels_(pieces.deal()) {
    const typename Piece::Settings settings = {&options_, step_of<Real>(options), radius_,
                                               false,     pieces.summary().faces, pieces.unit()};
    for (std::size_t i = 0; i < pieces.parts().size(); ++i)
      labels_.add(pieces.cut_of(pieces.parts()[i]), rooms.sheet(i), rooms.room(i), like, settings);
  }
  PartedLabels(const PartedLabels&) = delete;
  PartedLabels& operator=(const PartedLabels&) = delete;

  /// False if a budget ended it.
  bool run() {
    const SurfacePartsSummary& summary = pieces_.summary();
    const double size = static_cast<double>(summary.faces) / static_cast<double>(summary.pieces);
    const PieceSettings settings = {.size = static_cast<std::size_t>(size)};
    Supersteps<Piece> supersteps(team_, pieces_.cut(), labels_,
                                 static_cast<Real>(settings.pace * std::sqrt(size)), summary.faces,
                                 pieces_.unit(), options_, counts_);
    const auto goes_on = [&](std::size_t expansions, std::size_t) {
      check_end(expansions, summary.faces);
      return true;
    };
    std::size_t pinched = 0;
    for (std::size_t i = 0; i < labels_.size(); ++i) pinched += rooms_.pinched(i).size();
    pinched = sum_of(team_.ranks(), pinched);
    team_.each(labels_.size(), [&](std::size_t i) { seed(i); });
    bool complete = true;
    int revivals = 0;
    do {
      for (Piece& piece : labels_) piece.set_last_resort(Propagation::last_resort(revivals));
      complete = supersteps.run({}, goes_on);
      ++revivals;
    } while (complete && ((pinched > 0 && pass_pinches()) || revive()));
    statistics_ = supersteps.statistics();
    statistics_.reached_simplices = reached();
    return complete;
  }
  [[nodiscard]] const PropagateStatistics& statistics() const { return statistics_; }

  /// Of all pieces of this process, before they agree: distances at the sources too.
  [[nodiscard]] std::vector<PartDistances<Real>> read_out() {
    std::vector<PartDistances<Real>> known(labels_.size());
    team_.each(known.size(), [&](std::size_t i) {
      labels_[i].read_out();
      TriangleRoom<Real>& room = rooms_.room(i);
      known[i].distance.swap(room.vertex);
      known[i].error.assign(known[i].distance.size(), 0);
      if constexpr (kLabels) known[i].source.swap(room.vertex_source);
    });
    each_as_surface(team_, pieces_, std::span(known),
                    [&](std::size_t i, WorkspaceState<Real>& workspace) {
                      const PartSources::Here here = sources_.here[i].ascending();
                      surface::read_out_sources<Real, kLabels>(
                          *pieces_.parts()[i].mesh, here.points, workspace, here.numbers);
                    });
    return known;
  }

  /// Vertices that no triangle offered a distance take the best path to one of their corners.
  void read_out_rest(std::span<PartDistances<Real>> known) {
    each_as_surface(team_, pieces_, known, [&](std::size_t i, WorkspaceState<Real>& workspace) {
      const PartPiece<Real>& part = pieces_.parts()[i];
      for (Index v = 0; v < part.vertices.size(); ++v)
        if (!(workspace.vertex[v] < std::numeric_limits<Real>::infinity()))
          read_out_around<Real, kLabels>(*part.mesh, labels_[i].rule(), labels_[i].front(), v,
                                         workspace);
    });
  }

 private:
  using Front = PieceFront<Real, Label, kLabels>;
  using Rule = decltype(std::declval<const Like&>().over(std::span<const TriangleRecord<Real>>(),
                                                         std::declval<Front&>()));
  using Piece = TrianglePiece<Real, Label, Rule, kLabels>;
  using Propagation = TrianglePropagation<Real, Rule, Front, kLabels>;
  using Path = typename Propagation::Path;

  /// Calls work(propagation) on our piece i as on a surface; afterwards what got a label waits.
  template <class Work>
  void on(std::size_t i, bool ghosts, const Work& work) {
    labels_[i].offer(ghosts, [&] {
      WorkspaceState<Real> workspace;
      Propagation propagation(*pieces_.parts()[i].mesh, workspace, labels_[i].rule(),
                              labels_[i].front(), options_);
      work(propagation);
    });
  }

  /// Where a ghost has the source, it is what sees the piece: it gets the label, too.
  void seed(std::size_t i) {
    const PartSources::Here& here = sources_.here[i];
    const auto own = static_cast<Index>(pieces_.parts()[i].own);
    for (const bool ghosts : {false, true})
      on(i, ghosts, [&](Propagation& propagation) {
        for (std::size_t n = 0; n < here.points.size(); ++n) {
          const PointSource& source = here.points[n];
          const bool in_ghost = source.vertex == none && source.simplex >= own;
          if (in_ghost == ghosts) propagation.seed(source, here.numbers[n]);
        }
      });
  }

  /// Pieces that have a vertex tell each other their best path to it; each goes on from the best of
  /// all.
  bool pass_pinches() {
    std::vector<std::vector<Path>> best(labels_.size());
    const auto place_of = [&](std::size_t i, Index v) {
      const auto pinched = rooms_.pinched(i);
      const auto found = std::lower_bound(pinched.begin(), pinched.end(), v);
      return found != pinched.end() && *found == v ? found - pinched.begin() : -1;
    };
    for (std::size_t i = 0; i < labels_.size(); ++i)
      on(i, false, [&](Propagation& propagation) {
        for (const Index v : rooms_.pinched(i))
          best[i].push_back(propagation.path_to(v, static_cast<Index>(pieces_.parts()[i].own)));
      });
    const std::vector<std::vector<Path>> told = best;
    counts_.sent += pieces_.tell_peers(
        team_.ranks(),
        [&](std::size_t i, std::size_t peer, Parcel& parcel) {
          for (const Index v : pieces_.parts()[i].common[peer])
            if (const auto k = place_of(i, v); k >= 0)
              parcel.add(told[i][static_cast<std::size_t>(k)]);
        },
        [&](std::size_t i, std::size_t peer, Unpacked& mail) {
          for (const Index v : pieces_.parts()[i].common[peer])
            if (const auto k = place_of(i, v); k >= 0) {
              const Path other = mail.take<Path>();
              Path& own = best[i][static_cast<std::size_t>(k)];
              if (std::tie(other.distance, other.source) < std::tie(own.distance, own.source))
                own = other;
            }
        });
    return team_.any(labels_.size(), [&](std::size_t i) {
      bool bent = false;
      on(i, false, [&](Propagation& propagation) {
        for (std::size_t k = 0; k < best[i].size(); ++k)
          bent |= propagation.bend_at(rooms_.pinched(i)[k], best[i][k],
                                      static_cast<Index>(pieces_.parts()[i].own));
      });
      return bent;
    });
  }

  bool revive() {
    if (radius_ < std::numeric_limits<Real>::infinity() || reached() == pieces_.summary().faces)
      return false;
    return team_.any(labels_.size(), [&](std::size_t i) {
      bool revived = false;
      on(i, false, [&](Propagation& propagation) { revived = propagation.revive_all(); });
      return revived;
    });
  }

  /// Triangles of all pieces.
  [[nodiscard]] std::size_t reached() const {
    std::size_t sum = 0;
    for (const Piece& piece : labels_) sum += piece.count_reached();
    return sum_of(team_.ranks(), sum);
  }

  const Team& team_;
  const PartPieces<Real>& pieces_;
  PartLabelRooms<Real>& rooms_;
  const PartSources& sources_;
  const PropagateOptions& options_;
  SuperstepCounts& counts_;
  Real radius_;
  OurPieces<Piece> labels_;
  PropagateStatistics statistics_;
};

}  // namespace plexway::detail
