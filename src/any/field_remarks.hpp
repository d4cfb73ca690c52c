#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include <plexway/any_domain.hpp>

namespace plexway {

/// How far a field got.
struct FieldReach {
  std::size_t reached = 0;        ///< vertices, sources included
  std::size_t beside_source = 0;  ///< reached, and not a source
  double max_distance = 0;        ///< -inf where nothing is reached
  std::size_t sources = 0;        ///< points, and vertices of sets
  std::size_t farthest = 0;       ///< a vertex at that distance
  std::vector<std::size_t> from;  ///< vertices that are sources, and reached; ascending
};
[[nodiscard]] FieldReach reach_of(std::span<const double> distance,
                                  std::span<const Source> sources);

/// Why vertices may not be reached where a radius or a number of expansions was given.
inline constexpr const char* bounded_search = "--radius or --max-expansions ends the search early";

/// What a user should know of a field though nothing failed, a sentence each: points dropped, work
/// that ended early, distances that are poor, vertices that no path reaches and why. `bounded`: a
/// radius or a number of expansions was given.
[[nodiscard]] std::vector<std::string> field_remarks(const AnyDomain& domain, const AnyField& field,
                                                     const FieldReach& reach, bool bounded);

}  // namespace plexway
