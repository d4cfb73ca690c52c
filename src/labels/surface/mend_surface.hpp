#pragma once

#include <cstddef>
#include <span>

#include "labels/read_out_edges.hpp"
#include "labels/straight_lines.hpp"

namespace plexway::surface {

/// What `mend` did.
struct Mended {
  std::size_t raised = 0;   ///< vertices below the straight line, by more than 1e-4
  std::size_t lowered = 0;  ///< vertices that got nearer by more than 1e-4
};

/// Distances at vertices that can only be wrong: those below the straight line in space, from
/// `sources` that are nothing but points (none: not looked at), and those above a neighbour's and
/// the edge between.
template <class Real, bool kLabels, class Crew>
Mended mend(const TriangleMesh<Real>& mesh, std::span<const PointSource> sources,
            WorkspaceState<Real>& workspace, const Crew& crew) {
  const StraightLines<Real> lines(mesh, sources);
  Mended mended;
  mended.raised = lines.template raise<kLabels>(workspace, crew);
  const Lowered lowered = read_out_edges<Real, kLabels>(mesh, workspace, crew);
  mended.lowered = lowered.much;
  // What sums of many edges lost by rounding.
  if (lowered.any) lines.template raise<kLabels>(workspace, crew);
  return mended;
}

}  // namespace plexway::surface
