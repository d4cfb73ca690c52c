#pragma once

#include <algorithm>
#include <cstddef>
#include <limits>
#include <span>
#include <vector>

#include "executors/parts/part_pieces.hpp"
#include "executors/parts/part_sources.hpp"
#include "labels/alone.hpp"
#include "labels/surface/repair_surface.hpp"
#include "labels/workspace_state.hpp"

namespace plexway::detail {

/// What is known of the vertices of one piece, by its numbers.
template <class Number>
struct PartDistances {
  std::vector<Number> distance, error;  ///< in mean edges
  std::vector<Index> source;            ///< empty for a single one

  /// Takes what is nearer, or as near from an earlier source, or as near with a larger error. Did
  /// it?
  bool take(std::size_t vertex, Number d, Number e, Index s) {
    if (!(d <= distance[vertex]) || !(d < std::numeric_limits<Number>::infinity())) return false;
    if (d == distance[vertex]) {
      const Index own = source.empty() ? s : source[vertex];
      if (s > own || (s == own && !(e > error[vertex]))) return false;
    }
    distance[vertex] = d;
    error[vertex] = e;
    if (!source.empty()) source[vertex] = s;
    return true;
  }
};

/// Pieces tell each other what they know of vertices that both have, and keep the better. Did any
/// learn something, anywhere? All processes call it.
template <class Real, class Number>
bool agree(PieceRanks* ranks, const PartPieces<Real>& pieces,
           std::span<PartDistances<Number>> known, std::size_t& sent) {
  struct Told {
    Number distance, error;
    Index source;
  };
  std::size_t changed = 0;
  sent += pieces.tell_peers(
      ranks,
      [&](std::size_t i, std::size_t peer, Parcel& parcel) {
        const PartDistances<Number>& own = known[i];
        for (const Index v : pieces.parts()[i].common[peer])
          parcel.add(
              Told{own.distance[v], own.error[v], own.source.empty() ? none : own.source[v]});
      },
      [&](std::size_t i, std::size_t peer, Unpacked& mail) {
        for (const Index v : pieces.parts()[i].common[peer]) {
          const Told told = mail.template take<Told>();
          changed += known[i].take(v, told.distance, told.error, told.source);
        }
      });
  return sum_of(ranks, changed) > 0;
}

/// Calls work(i, workspace) by a team with what is known in each of our pieces as of a surface:
/// nothing is known of vertices that only ghosts have. With labels unless there is one source.
template <class Real, class Work>
void each_as_surface(const Team& team, const PartPieces<Real>& pieces,
                     std::span<PartDistances<Real>> known, const Work& work) {
  team.each(known.size(), [&](std::size_t i) {
    PartDistances<Real>& own = known[i];
    const std::size_t count = own.distance.size(), all = pieces.parts()[i].mesh->vertex_count();
    const bool labels = !own.source.empty();
    WorkspaceState<Real> workspace;
    workspace.vertex.swap(own.distance);
    workspace.vertex.resize(all, std::numeric_limits<Real>::infinity());
    workspace.vertex_source.swap(own.source);
    if (labels) workspace.vertex_source.resize(all, none);
    work(i, workspace);
    workspace.vertex.resize(count);
    workspace.vertex.swap(own.distance);
    if (labels) workspace.vertex_source.resize(count);
    workspace.vertex_source.swap(own.source);
  });
}

/// As surface::repair, on a surface in parts: vertices are raised to straight lines where they are,
/// and lowered along edges piece by piece until none hears of anything nearer. What comes out of
/// that is the least over all ways, whoever goes first.
template <class Real, bool kLabels>
class PartRepair {
 public:
  PartRepair(const Team& team, const PartPieces<Real>& pieces, const PartSources& sources,
             std::span<PartDistances<Real>> known)
      : team_(team), pieces_(pieces), sources_(sources), known_(known) {}

  surface::Repaired run(std::size_t& sent) {
    surface::Repaired repaired;  // here
    repaired.raised = raise();
    std::vector<std::vector<Real>> before(known_.size());
    for (std::size_t i = 0; i < known_.size(); ++i) before[i] = known_[i].distance;
    bool any = false;
    do any |= lower();
    while (agree(team_.ranks(), pieces_, known_, sent));
    if (team_.any(any)) {
      for (std::size_t i = 0; i < known_.size(); ++i)
        repaired.lowered += count(i, [&](std::size_t v) {
          return known_[i].distance[v] < before[i][v] * Real(1 - 1e-4);
        });
      raise();
      agree(team_.ranks(), pieces_, known_, sent);  // pieces see lines from where they are
    }
    return {sum_of(team_.ranks(), repaired.raised), sum_of(team_.ranks(), repaired.lowered)};
  }

 private:
  /// Returns how many vertices were below by more than `much_nearer`, each in its first piece.
  std::size_t raise() {
    std::vector<std::size_t> raised(known_.size(), 0);
    each_as_surface(team_, pieces_, known_, [&](std::size_t i, WorkspaceState<Real>& workspace) {
      const PartPiece<Real>& part = pieces_.parts()[i];
      const auto places = sources_.places(part, pieces_.unit());
      const StraightLines<Real> lines(part.mesh->positions(), places);
      std::vector<Real> before = workspace.vertex;
      if (lines.template raise<kLabels>(workspace, Alone{}) > 0)
        raised[i] = count(i, [&](std::size_t v) {
          return before[v] < workspace.vertex[v] * Real(1 - much_nearer);
        });
    });
    std::size_t sum = 0;
    for (const std::size_t one : raised) sum += one;
    return sum;
  }

  bool lower() {
    std::vector<char> any(known_.size(), 0);
    each_as_surface(team_, pieces_, known_, [&](std::size_t i, WorkspaceState<Real>& workspace) {
      const TriangleMesh<Real>& mesh = *pieces_.parts()[i].mesh;
      workspace.front.reserve(mesh.face_count());
      any[i] = read_out_edges<Real, kLabels>(mesh, workspace, Alone{}).any;
    });
    return std::any_of(any.begin(), any.end(), [](char one) { return one != 0; });
  }

  /// Vertices that this piece is the first to have.
  template <class Wanted>
  std::size_t count(std::size_t i, const Wanted& wanted) const {
    const PartPiece<Real>& part = pieces_.parts()[i];
    std::size_t sum = 0;
    for (Index v = 0; v < part.vertices.size(); ++v)
      sum += wanted(v) && part.is_first(v, pieces_.cut_of(part));
    return sum;
  }

  const Team& team_;
  const PartPieces<Real>& pieces_;
  const PartSources& sources_;
  std::span<PartDistances<Real>> known_;
};

}  // namespace plexway::detail
