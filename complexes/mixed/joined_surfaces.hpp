#pragma once

#include <array>
#include <span>

#include <plexway/surface/triangle_mesh.hpp>

#include "complexes/solid/shared_faces.hpp"

namespace plexway {

/// Surfaces to become one: their vertices' numbers in it, in the caller's order of each.
template <class Real>
struct JoinedPart {
  const TriangleMesh<Real>* mesh;
  std::span<const Index> vertex;
};

/// Edges that two of them have.
struct SurfaceSeam {
  Index part[2];
  SharedFaces shared;
};

/// One surface of `vertices` vertices, glued along what its parts share. Triangles keep their
/// lengths and angles, faces the order of parts. Where lengths of an edge differ by more than 1e-6
/// paths are refracted.
template <class Real>
TriangleMesh<Real> join_surfaces(std::size_t vertices, std::span<const JoinedPart<Real>> parts,
                                 std::span<const SurfaceSeam> seams);

}  // namespace plexway
