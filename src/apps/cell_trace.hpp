#pragma once

#include <span>

#include <plexway/apps/path.hpp>
#include <plexway/source/point_source.hpp>

#include "apps/cells.hpp"

namespace plexway {

/// A shortest path on a mixed domain from its vertices' distances alone: the shortest way over
/// places in the cells (search_cells), pulled taut and improved around what holds it. Where that is
/// longer than the distance by more than 5e-4, with more places. `distance`, by number in Cells,
/// are those of `sources`. Without positions. An empty path where none leads.
Path trace_cells(const Cells& all, std::span<const double> distance,
                 std::span<const PointSource> sources, const PointSource& point);

}  // namespace plexway
