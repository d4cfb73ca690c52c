#pragma once

#include <algorithm>
#include <cstddef>
#include <span>
#include <vector>

#include "executors/parts/part_distances.hpp"
#include "executors/parts/part_sources.hpp"
#include "labels/alone.hpp"
#include "labels/surface/repair_surface.hpp"

namespace plexway::detail {

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
