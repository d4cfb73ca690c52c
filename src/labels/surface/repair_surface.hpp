#pragma once

#include <algorithm>
#include <cstddef>
#include <span>
#include <vector>

#include "labels/read_out_edges.hpp"
#include "labels/straight_lines.hpp"

namespace plexway::detail::surface {
/// What `repair` did.
struct Repaired {
  std::size_t raised = 0;   ///< vertices below the straight line, by more than 1e-3
  std::size_t lowered = 0;  ///< vertices that got nearer by more than 1e-4
};

/// What a bounded solve reached, in the numbers inside, ascending.
struct Reached {
  std::vector<Index> vertices, triangles;  ///< those with a corner there

  /// Takes the vertices, and finds the triangles.
  template <class Real>
  void find_triangles(const TriangleMesh<Real>& mesh) {
    triangles.clear();
    std::vector<Index> corners;
    for (const Index v : vertices) {
      mesh.corners_at(v, corners);
      for (const Index corner : corners) triangles.push_back(corner / 3);
    }
    std::sort(triangles.begin(), triangles.end());
    triangles.erase(std::unique(triangles.begin(), triangles.end()), triangles.end());
  }
};

/// Distances at vertices that can only be wrong: those below the straight line in space, from
/// `sources` that are nothing but points (none: not looked at), and those above a neighbour's and
/// the edge between. Looks at what was reached alone, if that is known (else null), as all else is
/// right.
template <class Real, bool kLabels, class Scheduler>
Repaired repair(const TriangleMesh<Real>& mesh, std::span<const PointSource> sources,
                WorkspaceState<Real>& workspace, const Scheduler& scheduler,
                const Reached* reached = nullptr) {
  const StraightLines<Real> lines(mesh, sources);
  const auto raise = [&] {
    if (reached == nullptr) return lines.template raise<kLabels>(workspace, scheduler);
    return lines.template raise<kLabels>(workspace, scheduler, reached->vertices.size(),
                                         [&](std::size_t n) { return reached->vertices[n]; });
  };
  Repaired repaired;
  repaired.raised = raise();
  const Lowered lowered =
      reached == nullptr
          ? read_out_edges<Real, kLabels>(mesh, workspace, scheduler)
          : read_out_edges<Real, kLabels>(mesh, workspace, scheduler, reached->triangles.size(),
                                          [&](std::size_t n) { return reached->triangles[n]; });
  repaired.lowered = lowered.much;
  // What sums of many edges lost by rounding.
  if (lowered.any) raise();
  return repaired;
}

}  // namespace plexway::detail::surface
