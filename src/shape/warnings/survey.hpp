#pragma once

#include <array>
#include <cstddef>
#include <limits>
#include <span>
#include <string>
#include <vector>

#include <plexway/shape/shape.hpp>

#include "complexes/common/box_tree.hpp"
#include "complexes/common/disjoint_sets.hpp"

namespace plexway::detail {

/// Bounding box of all vertices; both corners at 0 where there are none.
Box<3> bounding_box(std::span<const std::array<double, 3>> positions);

/// Whether no point is farther from the line through two of them than a ten-millionth of how far
/// those are apart; one point is none. Cost: linear.
bool lie_in_line(std::span<const std::array<double, 3>> positions);

/// Smallest, mean and largest of some lengths.
struct Spread {
  double min = std::numeric_limits<double>::infinity(), mean = 0, max = 0;
};
Spread spread_of(std::span<const double> lengths);

/// Vertices in use that lie exactly where another one does, of a surface, a solid or a wireframe
/// with positions; else 0. Cost: O(n log n).
std::size_t count_coincident(const AnyShape& shape);

/// Vertices that simplices, of a cloud neighbours, hold together.
DisjointSets joined_vertices(const AnyShape& shape);

/// Vertices in each component that has simplices, most first.
std::vector<std::size_t> component_sizes(const AnyShape& shape);

/// "3 components: a source reaches only its own ..."
std::string components_warning(std::size_t components);

}  // namespace plexway::detail
