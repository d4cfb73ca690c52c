#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include <plexway/common/ids.hpp>

namespace plexway {

/// across[f][i]: the halfedge 3 g + j that comes after halfedge 3 f + i around its edge, or none.
using Gluing = std::vector<std::array<Index, 3>>;
using Faces = std::span<const std::array<Index, 3>>;

/// Glues triangles where two corners share both vertices. More than two on an edge form a cycle.
Gluing glue_by_vertices(std::size_t vertices, Faces faces);

/// Throws InputError where `across` is not made of cycles over the same pair of vertices.
void check_gluing(Faces faces, std::span<const std::array<Index, 3>> across);

}  // namespace plexway
