#pragma once

#include <cstddef>
#include <vector>

#include <plexway/complex/triangle_mesh.hpp>

#include "complex/intrinsic_triangulation.hpp"

namespace plexway {

/// Adds a line between two vertices, but none from a vertex to itself.
void add_chord(std::vector<SurfaceChord>& to, Index v, Index w, double length);

/// Edges of the input that are none any more: straight lines still. `then` has those of slots that
/// something happened to, and lines that the input knew.
std::vector<SurfaceChord> lost_edges(std::vector<SurfaceChord> then,
                                     const IntrinsicTriangulation& now, std::size_t input_faces);

}  // namespace plexway
