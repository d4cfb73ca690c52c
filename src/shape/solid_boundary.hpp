#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include <plexway/io/tets.hpp>
#include <plexway/io/triangles.hpp>

namespace plexway {

/// The faces of one tetrahedron only, counterclockwise from outside. Cost: O(n log n).
std::vector<std::array<std::uint32_t, 3>> boundary_faces(
    std::span<const std::array<double, 3>> positions,
    std::span<const std::array<std::uint32_t, 4>> tets);

/// The same with the vertices they have, in their order.
io::Triangles boundary_of(const io::Tets& solid);

}  // namespace plexway
