#pragma once

#include <span>

#include <plexway/complex/wireframe.hpp>
#include <plexway/executors/serial.hpp>

namespace plexway {

/// The distance along the edges of every vertex from the nearest of `sources`: a vertex, or any
/// point of an edge (`PointSource::in(edge, {b0, b1})`). Exact up to rounding.
///
/// As for surfaces, with these differences: labels sit at the vertices, so that the statistics,
/// `max_expansions` and the progress count vertices, and the radius cuts off vertices; there is no
/// `visibility` to choose, since every path bends at every vertex; `vectorised = false` runs the
/// literal hinge kernel; `step` counts in typical edges, Wireframe::typical_edge. Where lengths of
/// very different size make the dual queue look at edges four times on average, nearest first takes
/// over.
///
/// Throws as for surfaces. Cost: 25 to 60 ns a vertex on lattices of a million, a fifth of Boost's
/// Dijkstra; never more than O((n + m) log n), but for Schedule::fifo.
template <class Real>
void propagate(Serial, const Wireframe<Real>& wireframe, std::span<const PointSource> sources,
               const PropagateOptions& options, Workspace<Real>& workspace,
               DistanceField<Real>& field);

/// The same with a workspace of its own.
template <class Real>
[[nodiscard]] DistanceField<Real> propagate(Serial executor, const Wireframe<Real>& wireframe,
                                            std::span<const PointSource> sources,
                                            const PropagateOptions& options = {});

/// From a single source.
template <class Real>
[[nodiscard]] DistanceField<Real> propagate(Serial executor, const Wireframe<Real>& wireframe,
                                            const PointSource& source,
                                            const PropagateOptions& options = {}) {
  return propagate(executor, wireframe, std::span<const PointSource>(&source, 1), options);
}

}  // namespace plexway
