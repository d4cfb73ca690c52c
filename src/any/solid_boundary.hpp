#pragma once

#include <plexway/io/tets.hpp>
#include <plexway/io/triangles.hpp>

namespace plexway {

/// The faces of one tetrahedron only, counterclockwise from outside, with the vertices they have,
/// in their order. Cost: O(n log n).
io::Triangles boundary_of(const io::Tets& solid);

}  // namespace plexway
