#pragma once

#include <array>
#include <cstddef>

#include <plexway/io/edges.hpp>
#include <plexway/io/tets.hpp>
#include <plexway/io/triangles.hpp>

namespace plexway::cli {

/// A point of a simplex.
struct SimplexPoint {
  std::size_t simplex = 0;
  /// Of its corners: >= 0, sum 1; 0 beyond them.
  std::array<double, 4> barycentric = {1, 0, 0, 0};
};

/// The point of a domain (which has simplices, and positions) that is closest to `point`, finite
/// coordinates: of a solid that is the point itself where it lies inside. Among equally close ones,
/// the one of the first simplex. Cost: one pass over the simplices.
SimplexPoint closest_point(const io::Triangles& surface, const std::array<double, 3>& point);
SimplexPoint closest_point(const io::Tets& solid, const std::array<double, 3>& point);
SimplexPoint closest_point(const io::Edges& wireframe, const std::array<double, 3>& point);

}  // namespace plexway::cli
