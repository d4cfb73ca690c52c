#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include <plexway/common/ids.hpp>

#include "complexes/cloud/sheet_wedges.hpp"
#include "complexes/cloud/umbrella.hpp"

namespace plexway::detail {

/// What hangs together.
struct CloudParts {
  std::vector<Index> part;  ///< of each place, one of its places
  std::size_t bridges = 0;
  std::size_t joints = 0;  ///< of these, between places that were in triangles
};

/// Connects parts of the sheet, and places in no triangle, over neighbours on one sheet, the
/// nearest first, by triangles that have the segment as an edge. A place that no neighbour goes
/// with is connected to the nearest of them. Where neither end is in a triangle, a place halfway is
/// added to `places`.
CloudParts bridge_parts(const SheetRule& rule, std::span<const TangentFrame> frames, Places& places,
                        SheetWedges& sheet);

}  // namespace plexway::detail
