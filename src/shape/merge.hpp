#pragma once

#include <string>

#include <plexway/shape/open_simplices.hpp>

#include "shape/shape_state.hpp"

namespace plexway {

/// Makes vertices one that are no farther apart than `tolerance`: AnyShape::merged. Of other kinds
/// than surfaces, solids and wireframes with positions nothing. Simplices that lose a corner by it
/// are still to be found.
void merge_vertices(AnyShape::State& state, double tolerance);

/// Looks for simplices with a corner twice. They have no area and no place in a complex, but keep
/// their numbers: they are as if masked. (An edge from a vertex to itself is one that no path
/// takes.)
void find_collapsed(AnyShape::State& state);

/// "2 triangles have a corner twice and are left out, 17 is the first"; empty where none has.
[[nodiscard]] std::string collapsed_sentence(const AnyShape& shape);

}  // namespace plexway
