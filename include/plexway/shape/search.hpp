#pragma once

#include <span>

#include <plexway/any_domain.hpp>
#include <plexway/paths/path_search.hpp>

namespace plexway {

/// Paths from the nearest of the sources to each target without looking at all of a surface, kind
/// and precision hidden; see PathSearch, whose straight line is the bound where the surface has
/// positions and no metric. On the shape's own triangles; sources, targets and paths have its
/// numbers, behind a mask, too, and paths have positions wherever the shape has. Throws UsageError
/// as PathSearch, for other kinds, and for a point in a simplex that is masked.
[[nodiscard]] SearchResult find_paths(const AnyDomain& domain, std::span<const PointSource> sources,
                                      std::span<const PointSource> targets,
                                      const SearchOptions& options = {});

}  // namespace plexway
