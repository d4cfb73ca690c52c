#pragma once

#include "shape/shape_state.hpp"

namespace plexway {

/// Makes vertices one that are no farther apart than `tolerance`: AnyShape::merged. Of other kinds
/// than surfaces, solids and wireframes with positions nothing. Simplices that lose a corner by it
/// are still to be found.
void merge_vertices(AnyShape::State& state, double tolerance);

}  // namespace plexway
