#pragma once

#include <span>

#include <plexway/complex/simplicial_complex.hpp>
#include <plexway/executors/serial.hpp>

namespace plexway {

/// The distance of every vertex of a domain of dimension N = 1 to 4 from the nearest of `sources`.
///
/// Where the complex lies flat in R^N (SimplicialSummary::flat) and the policy is
/// Visibility::saddles, the default, paths are strings that are pulled around obstacles
/// (SimplexStringRule): no distance is below the exact one by more than rounding, straight lines
/// and single bends are exact, and what is longer than need be is so by less than a cell.
///
/// Else the plain step: exact where no obstacle is in the way (and for N = 1), else within the
/// resolution of the complex. Visibility::upper_bound aims at apexes: every distance is the length
/// of a path that exists, up to rounding. Every other policy aims at centroids, which is more
/// accurate. A source is a vertex or, for N < 4, a point of a simplex. Workspace, results and errors
/// are as for surfaces (executors/serial.hpp); UsageError also for a source inside a simplex with
/// N = 4.
/// Source: Trettner, Bommes, Kobbelt: Geodesic Distance Computation via Virtual Source
/// Propagation, SGP 2021, sections 3 and 5, there for triangles
/// (the plain step).
template <class Real, int N>
void propagate(Serial, const SimplicialComplex<Real, N>& domain,
               std::span<const PointSource> sources, const PropagateOptions& options,
               Workspace<Real>& workspace, DistanceField<Real>& field);

/// The same with a workspace of its own.
template <class Real, int N>
[[nodiscard]] DistanceField<Real> propagate(Serial executor,
                                            const SimplicialComplex<Real, N>& domain,
                                            std::span<const PointSource> sources,
                                            const PropagateOptions& options = {}) {
  Workspace<Real> workspace;
  DistanceField<Real> field;
  propagate(executor, domain, sources, options, workspace, field);
  return field;
}

/// From a single source.
template <class Real, int N>
[[nodiscard]] DistanceField<Real> propagate(Serial executor,
                                            const SimplicialComplex<Real, N>& domain,
                                            const PointSource& source,
                                            const PropagateOptions& options = {}) {
  return propagate(executor, domain, std::span<const PointSource>(&source, 1), options);
}

}  // namespace plexway
