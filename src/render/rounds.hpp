#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "skins.hpp"

namespace plexway::render {

/// A ball. `rings` from pole to pole; twice as many around.
void add_ball(Batch& batch, const Vertex& centre, double radius, std::size_t rings);

/// A flat ring around a place, facing the camera: where a ball is that something hides.
void add_ring(std::vector<Corner>& corners, const Vertex& centre, double inner, double outer,
              const Point& toward);

/// A tube along a polyline, closed by balls at its ends and at sharp bends.
void add_tube(Batch& batch, std::span<const Vertex> line, double radius, std::size_t sides);

/// The edges of a part as tubes with balls where they meet; thinner where edges are short.
void add_wires(Batch& batch, const Part& part, const Making& making);

/// The points of a part as discs, the rounder the larger they are, wide enough to touch their
/// neighbours: along the normals where there are some, else as balls seen from the camera.
void add_discs(Batch& batch, const Part& part, const Making& making);

}  // namespace plexway::render
