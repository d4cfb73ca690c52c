#pragma once

#include <span>

#include <plexway/common/rows_of.hpp>
#include <plexway/paths/path.hpp>
#include <plexway/surface/triangle_mesh.hpp>

namespace plexway {

/// The path that a given one becomes when it is pulled tight between its ends, as a rubber band on
/// the surface: locally shortest, and of the same homotopy class, so that around a handle it stays
/// around it. Closed paths are pulled as open ones, with their ends where they are.
///
/// The straight line from each point to the next lies in the simplex of the first of the two, as in
/// what PathField::trace returns. `positions`, one a vertex in the caller's order, are those that
/// the surface was made from, or none. `Path::source` is none. Throws UsageError for no point,
/// points that are not in the surface or, one after the other, in no common triangle, and for
/// surfaces with refracting edges. Cost: linear in the triangles on the way, and as much again for
/// each vertex that it is pulled over.
template <class Real>
[[nodiscard]] Path shortened(const TriangleMesh<Real>& mesh, std::span<const PathPoint> path,
                             const GivenPoints& positions = {});

}  // namespace plexway
