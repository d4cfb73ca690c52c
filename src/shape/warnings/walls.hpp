#pragma once

#include <plexway/io/tets.hpp>
#include <plexway/source/source.hpp>

namespace plexway {

/// The whole boundary of a solid as a source: its faces, and not their vertices alone.
///
/// The ball around a point that just touches the boundary lies inside, so the distance is that of
/// the nearest face in space, and every vertex starts with it: exact, whatever lies in the way
/// elsewhere. Not so where lengths are not those in space, or where a solid lies over itself.
/// No vertices where there is no boundary. Cost: O(n log n), near the boundary.
VertexSource walls_of(const io::Tets& solid);

/// What is left of it where lengths are others: the vertices of the boundary.
VertexSource rim_of(const VertexSource& walls);

}  // namespace plexway
