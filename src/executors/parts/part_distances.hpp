#pragma once

#include <cstddef>
#include <limits>
#include <span>
#include <vector>

#include "executors/parts/part_pieces.hpp"
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

}  // namespace plexway::detail
