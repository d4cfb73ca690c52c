#pragma once

#include <span>
#include <string>
#include <vector>

#include <plexway/source/source.hpp>

#include "domain.hpp"

namespace plexway::cli {

/// Points joined by shortest paths, as a curve through the simplices between. `text` names the
/// source in messages. Throws UsageError where the domain is neither a surface nor a wireframe,
/// InputError where no path leads.
std::vector<PointSource> joined(const Domain& domain, std::span<const PointSource> points,
                                const std::string& text);

/// The whole boundary: of a surface as a curve, of a solid the vertices of its boundary, of a
/// wireframe the ends of single edges. Throws InputError where there is none, UsageError for a
/// cloud.
Source boundary_of(const Domain& domain, double offset);

}  // namespace plexway::cli
