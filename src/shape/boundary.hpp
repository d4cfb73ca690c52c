#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include <plexway/io/edges.hpp>
#include <plexway/io/tets.hpp>
#include <plexway/io/triangles.hpp>
#include <plexway/shape/shape.hpp>
#include <plexway/source/source.hpp>

#include "io/field/field_formats.hpp"

namespace plexway::detail {

/// The faces of one tetrahedron only, counterclockwise from outside. Cost: O(n log n).
std::vector<std::array<std::uint32_t, 3>> boundary_faces(
    std::span<const std::array<double, 3>> positions,
    std::span<const std::array<std::uint32_t, 4>> tets);

/// The same with the vertices they have, in their order.
io::Triangles boundary_of(const io::Tets& solid);

/// Vertices of the faces that only one simplex has, ascending. Cost: O(n log n).
std::vector<Index> rim_vertices(const io::Cells& cells);

/// The whole boundary of a solid as a source: its faces, and not their vertices alone.
///
/// The ball around a point that just touches the boundary lies inside, so the distance is that of
/// the nearest face in space, and every vertex starts with it: exact, whatever lies in the way
/// elsewhere. Not so where lengths are not those in space, or where a solid lies over itself.
/// No vertices where there is no boundary. Cost: O(n log n), near the boundary.
VertexSource walls_of(const io::Tets& solid);

/// What is left of it where lengths are others: the vertices of the boundary.
VertexSource rim_of(const VertexSource& walls);

/// The edges of all simplices, each once, ascending, with the positions of all vertices; a simplex
/// that names a vertex twice adds no loop. Cost: O(n log n).
/// Of a cloud, those from each point to its neighbours, measured as its paths are.
io::Edges edges_of(const AnyShape& shape);

/// One length an edge, where they are given and where they follow from the positions.
std::vector<double> lengths_of(const io::Edges& wireframe);

}  // namespace plexway::detail
