#pragma once

#include <array>
#include <span>
#include <vector>

#include <plexway/common/ids.hpp>
#include <plexway/openvdb/surface.hpp>

namespace plexway::openvdb {

/// Triangles with an even number of them at each edge.
struct ClosedSurface {
  std::vector<std::array<double, 3>> positions;
  std::vector<std::array<Index, 3>> triangles;
};

/// Welds vertices at the same place, leaves out what has no area, is there twice or is a sheet, and
/// closes rims by fans. Throws InputError where nothing is left. Cost: O(n log n).
ClosedSurface close_surface(std::span<const std::array<double, 3>> positions,
                            std::span<const std::array<Index, 3>> triangles, Repair& report);

}  // namespace plexway::openvdb
