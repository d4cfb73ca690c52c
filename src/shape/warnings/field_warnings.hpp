#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include <plexway/any_domain.hpp>
#include <plexway/shape/warnings.hpp>

namespace plexway::detail {

/// How far a field got.
struct FieldReach {
  std::size_t reached = 0;        ///< vertices, sources included
  std::size_t beside_source = 0;  ///< reached, and not a source
  double max_distance = 0;        ///< -inf where nothing is reached
  std::size_t farthest = 0;       ///< a vertex at that distance
  std::vector<std::size_t> from;  ///< vertices that are sources, and reached; ascending
};
[[nodiscard]] FieldReach reach_of(std::span<const double> distance, const SourceList& sources);

/// Of these vertices, from which nothing else is reached, the first that is in no simplex, and the
/// nearest that is in one; empty where all are in one.
[[nodiscard]] std::string apart_sentence(const AnyShape& domain, std::span<const std::size_t> from);

/// The work of fields, whoever has their domain.
struct FieldWork {
  const PropagateStatistics& statistics;  ///< a sum over the fields
  Accuracy accuracy;
  bool complete = true;
  bool has_windows = false;         ///< may the domain be solved by them?
  bool has_triangulations = false;  ///< may it be solved on others?
  std::size_t vertices = 0;
  std::size_t fields = 1;
  /// The longest distance in mean edges, of a surface in single precision; else 0.
  double edges = 0;
  bool in_space = true;  ///< have the vertices positions?
};
/// What it says of their distances.
[[nodiscard]] std::vector<Warning> work_warnings(const FieldWork& work, Reader reader);

/// So many vertices are not reached; `why` may be empty. `bounded`: a radius or a number of
/// expansions was given.
[[nodiscard]] Warning unreached_warning(std::size_t count, std::string why, bool bounded,
                                        Reader reader);
/// Was one?
[[nodiscard]] bool is_bounded(const PropagateOptions& options);

/// The longest distance of a field, and how many vertices it does not reach.
template <class Real>
double largest_of(const DistanceField<Real>& field) {
  double most = 0;
  for (const Real d : field)
    if (std::isfinite(d)) most = std::max(most, static_cast<double>(d));
  return most;
}
template <class Real>
std::size_t count_unreached(const DistanceField<Real>& field) {
  return static_cast<std::size_t>(
      std::count_if(field.begin(), field.end(), [](Real d) { return !std::isfinite(d); }));
}

/// How a cloud was given.
struct GivenCloud {
  std::size_t k = 0;             ///< neighbours that were sought; 0: not known
  bool normals_refused = false;  ///< were some given, and not taken?
};

/// What a complex says of all its fields.
template <class C>
[[nodiscard]] std::vector<Warning> complex_warnings(const C& complex, Reader reader,
                                                    const GivenCloud& given = {});

}  // namespace plexway::detail
