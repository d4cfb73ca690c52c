#pragma once

#include <vector>

#include <plexway/io/edges.hpp>
#include <plexway/io/tets.hpp>
#include <plexway/io/triangles.hpp>
#include <plexway/shape/shape.hpp>

namespace plexway {

/// The edges of all simplices, each once, ascending, with the positions of all vertices; a simplex
/// that names a vertex twice adds no loop. Cost: O(n log n).
io::Edges edges_of(const io::Triangles& surface);
io::Edges edges_of(const io::Tets& solid);
/// Of a cloud, those from each point to its neighbours, measured as its paths are.
io::Edges edges_of(const CloudShape& cloud);
/// Of any shape.
io::Edges edges_of(const AnyShape& shape);

/// One length an edge, where they are given and where they follow from the positions.
std::vector<double> lengths_of(const io::Edges& wireframe);

}  // namespace plexway
