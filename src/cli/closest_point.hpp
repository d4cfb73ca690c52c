#pragma once

#include <array>
#include <cstddef>

#include <plexway/io/triangles.hpp>

namespace plexway::cli {

/// A point of a triangle.
struct TrianglePoint {
  std::size_t triangle = 0;
  std::array<double, 3> barycentric = {1, 0, 0};  ///< of its corners: >= 0, sum 1
};

/// The point of `surface` (which has triangles) that is closest to `point`, finite coordinates.
/// Among equally close ones, the one of the first triangle. Cost: one pass over the triangles.
TrianglePoint closest_point(const io::Triangles& surface, const std::array<double, 3>& point);

}  // namespace plexway::cli
