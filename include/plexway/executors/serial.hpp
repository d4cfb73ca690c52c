#pragma once

#include <span>

#include <plexway/complex/triangle_mesh.hpp>
#include <plexway/propagate/distance_field.hpp>
#include <plexway/propagate/options.hpp>
#include <plexway/propagate/workspace.hpp>
#include <plexway/source/point_source.hpp>

namespace plexway {

/// One thread. The executor is the first argument of every operation.
struct Serial {};

/// The distance of every vertex from the nearest of `sources`.
///
/// `workspace` keeps the labels and is reused from call to call: solving again gives bit-identical
/// results and, once `field` and `workspace` have their size, allocates nothing. The workspace
/// belongs to one mesh and one thread at a time.
///
/// Throws UsageError for no source, a source that is not in the mesh, or options out of range, and
/// Cancelled when the progress callback says so. Cost: 50 to 80 ns a face.
/// Source: Trettner, Bommes, Kobbelt: Geodesic Distance Computation via Virtual Source
/// Propagation, SGP 2021.
template <class Real>
void propagate(Serial, const TriangleMesh<Real>& mesh, std::span<const PointSource> sources,
               const PropagateOptions& options, Workspace<Real>& workspace,
               DistanceField<Real>& field);

/// The same with a workspace of its own.
template <class Real>
[[nodiscard]] DistanceField<Real> propagate(Serial executor, const TriangleMesh<Real>& mesh,
                                            std::span<const PointSource> sources,
                                            const PropagateOptions& options = {});

/// From a single source.
template <class Real>
[[nodiscard]] DistanceField<Real> propagate(Serial executor, const TriangleMesh<Real>& mesh,
                                            const PointSource& source,
                                            const PropagateOptions& options = {}) {
  return propagate(executor, mesh, std::span<const PointSource>(&source, 1), options);
}

}  // namespace plexway
