#pragma once

#include <span>

#include <plexway/complex/tet_mesh.hpp>
#include <plexway/executors/serial.hpp>
#include <plexway/propagate/distance_field.hpp>
#include <plexway/propagate/options.hpp>
#include <plexway/propagate/workspace.hpp>
#include <plexway/source/point_source.hpp>

namespace plexway {

/// The distance of every vertex of a solid from the nearest of `sources`, through the solid.
///
/// With coordinates, Visibility::saddles bends paths at reflex edges; `centroid` is the plain step,
/// which bends anywhere; `upper_bound` measures only paths that exist. From lengths alone,
/// `saddles` is the plain step too.
///
/// `workspace` keeps the labels and is reused from call to call: solving again gives bit-identical
/// results and, once `field` and `workspace` have their size, allocates nothing. The workspace
/// belongs to one mesh and one thread at a time.
///
/// Throws UsageError for no source, a source that is not in the solid, options out of range, or
/// Visibility::tuned (a table for triangles), and Cancelled when the progress callback says so.
/// Source: Trettner, Bommes, Kobbelt: Geodesic Distance Computation via Virtual Source
/// Propagation, SGP 2021, there for triangles.
template <class Real>
void propagate(Serial, const TetMesh<Real>& mesh, std::span<const PointSource> sources,
               const PropagateOptions& options, Workspace<Real>& workspace,
               DistanceField<Real>& field);

/// The same with a workspace of its own.
template <class Real>
[[nodiscard]] DistanceField<Real> propagate(Serial executor, const TetMesh<Real>& mesh,
                                            std::span<const PointSource> sources,
                                            const PropagateOptions& options = {});

/// From a single source.
template <class Real>
[[nodiscard]] DistanceField<Real> propagate(Serial executor, const TetMesh<Real>& mesh,
                                            const PointSource& source,
                                            const PropagateOptions& options = {}) {
  return propagate(executor, mesh, std::span<const PointSource>(&source, 1), options);
}

}  // namespace plexway
