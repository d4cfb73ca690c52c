#pragma once

#include <vector>

#include <plexway/io/edges.hpp>
#include <plexway/shape/shape.hpp>

namespace plexway {

/// The edges of all simplices, each once, ascending, with the positions of all vertices; a simplex
/// that names a vertex twice adds no loop. Cost: O(n log n).
/// Of a cloud, those from each point to its neighbours, measured as its paths are.
io::Edges edges_of(const AnyShape& shape);

/// One length an edge, where they are given and where they follow from the positions.
std::vector<double> lengths_of(const io::Edges& wireframe);

}  // namespace plexway
