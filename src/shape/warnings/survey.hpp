#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <plexway/shape/shape.hpp>

namespace plexway {

/// Bounding box of all vertices; both corners at 0 where there are none.
struct Bounds {
  std::array<double, 3> low = {0, 0, 0}, high = {0, 0, 0};
};
Bounds bounding_box(std::span<const std::array<double, 3>> positions);

/// Whether no point is farther from the line through two of them than a ten-millionth of how far
/// those are apart; one point is none. Cost: linear.
bool lie_in_line(std::span<const std::array<double, 3>> positions);

/// Smallest, mean and largest of some lengths.
struct Spread {
  double min = std::numeric_limits<double>::infinity(), mean = 0, max = 0;
};
Spread spread_of(std::span<const double> lengths);

/// Vertices in use that lie exactly where another one does. Cost: O(n log n).
template <class Simplices>
std::size_t count_coincident(const std::vector<std::array<double, 3>>& at,
                             const Simplices& simplices) {
  std::vector<bool> used(at.size(), false);
  for (const auto& corners : simplices) {
    for (const auto v : corners) used[v] = true;
  }
  std::vector<std::uint32_t> order;
  for (std::uint32_t v = 0; v < used.size(); ++v) {
    if (used[v]) order.push_back(v);
  }
  std::sort(order.begin(), order.end(), [&](auto a, auto b) { return at[a] < at[b]; });
  std::size_t coincident = 0;
  for (std::size_t i = 0; i < order.size(); ++i) {
    const bool as_before = i > 0 && at[order[i - 1]] == at[order[i]];
    const bool as_after = i + 1 < order.size() && at[order[i + 1]] == at[order[i]];
    if (as_before || as_after) ++coincident;
  }
  return coincident;
}

/// Vertices in each component that has simplices, most first, as Boost.Graph counts them; nothing
/// where this build has no Boost.Graph.
std::optional<std::vector<std::size_t>> component_sizes(const AnyShape& domain);

/// "3 components: a source reaches only its own ..."
std::string components_warning(std::size_t components);

}  // namespace plexway
