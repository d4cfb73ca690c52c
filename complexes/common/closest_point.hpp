#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>

#include <plexway/common/ids.hpp>
#include <plexway/source/point_source.hpp>

namespace plexway::detail {

/// A point of a simplex.
struct SimplexPoint {
  std::size_t simplex = 0;
  /// Of its corners: >= 0, sum 1; 0 beyond them.
  std::array<double, 4> barycentric = {1, 0, 0, 0};
  /// From the point asked for, in a unit that depends on that and the positions alone.
  double squared_distance = std::numeric_limits<double>::infinity();
};

/// As a source: a corner where it is nearer to that than a rounding error of the coordinates.
PointSource source_at(const SimplexPoint& found, std::span<const Index> corners);

/// The point of some simplices that is closest to `point`, finite coordinates: of tetrahedra that
/// is the point itself where it lies inside. Among equally close ones, the one of the first
/// simplex. Cost: one pass over the simplices.
SimplexPoint closest_point(std::span<const std::array<double, 3>> positions,
                           std::span<const std::array<std::uint32_t, 2>> edges,
                           const std::array<double, 3>& point);
SimplexPoint closest_point(std::span<const std::array<double, 3>> positions,
                           std::span<const std::array<std::uint32_t, 3>> triangles,
                           const std::array<double, 3>& point);
SimplexPoint closest_point(std::span<const std::array<double, 3>> positions,
                           std::span<const std::array<std::uint32_t, 4>> tets,
                           const std::array<double, 3>& point);

/// Squared distance of the origin from a triangle, which may have no area. Corners of about 1.
double squared_distance(const std::array<std::array<double, 3>, 3>& corners);

}  // namespace plexway::detail
