#pragma once

#include <array>
#include <span>

#include <plexway/error.hpp>
#include <plexway/paths/path.hpp>
#include <plexway/solve/distance_field.hpp>
#include <plexway/solve/options.hpp>
#include <plexway/source/point_source.hpp>
#include <plexway/support.hpp>

#include "labels/workspace_state.hpp"
#include "windows/kept_windows.hpp"

namespace plexway::detail {

/// What a solve left behind, for those who trace paths in it.
template <class Real>
struct Solved {
  const WorkspaceState<Real>& workspace;
  const DistanceField<Real>& field;
  std::span<const PointSource> sources;
  std::span<const std::array<double, 3>> positions;  ///< caller's order; may be empty
  /// Where paths are drawn, if not there: lengths are then the domain's own. Surfaces only.
  std::span<const std::array<double, 3>> drawn;
  std::span<const Index> outer;  ///< from vertices inside to the caller's
  /// The caller's numbers of tetrahedra.
  std::span<const Index> outer_simplices;
  Visibility visibility;
  const windows::KeptWindows<Real>* windows = nullptr;  ///< of the field, or none. Surfaces only.
};

/// The way from a vertex that is a source itself, though no simplex has it; else `found`.
template <class Real>
Path or_no_way_at_all(Path found, const Solved<Real>& solved, const PointSource& from) {
  if (found.source != none || from.vertex == none) return found;
  for (Index k = 0; k < solved.sources.size(); ++k) {
    const PointSource& source = solved.sources[k];
    if (source.vertex != from.vertex) continue;
    if (found.source != none && !(source.offset < solved.sources[found.source].offset)) continue;
    found.source = k;
    found.length = 0;
  }
  return found;
}

/// Throws UsageError for a margin out of range, and one that means nothing on the domain.
template <class Domain>
void check(const TraceOptions& options, const Domain& domain) {
  if (!options.margin) return;
  support(Purpose::margins, domain).require();
  if (!(*options.margin >= 0 && *options.margin < 1))
    throw UsageError("the margin of a trace must be >= 0 and < 1");
}

/// The corner a source or target lies at, or 4.
inline std::size_t corner_of(const std::array<double, 4>& b) {
  for (std::size_t i = 0; i < 4; ++i)
    if (b[i] == 1) return i;
  return 4;
}

}  // namespace plexway::detail
