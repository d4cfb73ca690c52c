#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <span>
#include <string>

#include <plexway/common/ids.hpp>
#include <plexway/error.hpp>

namespace plexway::detail {

/// What isolines and isosurfaces ask of their input: UsageError, which calls a simplex and a level
/// set so.
template <std::size_t N>
void check_level_sets(std::size_t positions, std::span<const std::array<Index, N>> simplices,
                      std::span<const double> distance, std::span<const double> values,
                      const std::string& simplex, const std::string& level_set) {
  if (distance.size() != positions)
    throw UsageError(std::to_string(distance.size()) + " distances for " +
                     std::to_string(positions) + " positions: give one a vertex");
  for (const auto& corners : simplices)
    for (const Index v : corners)
      if (v >= positions)
        throw UsageError("vertex " + std::to_string(v) + " of a " + simplex + " is not there");
  for (const double value : values)
    if (!std::isfinite(value))
      throw UsageError("the value of an " + level_set + " must be a number");
}

}  // namespace plexway::detail
