#pragma once

#include <vector>

#include "draw_list.hpp"

namespace plexway::render {

/// Lines in a batch where the value is `value`, in the frame: of all triangles that are coloured by
/// it, joined over their edges.
std::vector<std::vector<Point>> contours(const Batch& batch, double value);

/// Whether all triangles of a batch meet and are coloured by one value, so that `contours` has all
/// its lines.
bool has_contours(const Batch& batch);

}  // namespace plexway::render
