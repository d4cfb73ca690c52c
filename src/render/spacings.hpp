#pragma once

#include <span>
#include <vector>

#include <plexway/render/picture.hpp>

namespace plexway::render {

/// How far each point's fourth nearest other place is, at most twice and at least half of what is
/// usual: how large the discs are that look like a surface. 0.1 each where all are at one place.
/// Wherever points are crowded or lonely, the cost is n log n.
[[nodiscard]] std::vector<double> spacings(std::span<const Point> points);

}  // namespace plexway::render
