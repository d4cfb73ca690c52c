#pragma once

#include <span>

#include <plexway/complex/triangle_mesh.hpp>
#include <plexway/executors.hpp>
#include <plexway/propagate/distance_field.hpp>
#include <plexway/propagate/options.hpp>

#include <plexway/propagate/workspace.hpp>
#include "executors/source_parts.hpp"

namespace plexway::detail {

/// Points and shapes on a surface, as one field.
void solve_shapes(const Serial& executor, const TriangleMesh<double>& mesh,
                  std::span<const Source> sources, SourceParts& parts,
                  const PropagateOptions& options, Workspace<double>& workspace,
                  DistanceField<double>& field);

}  // namespace plexway::detail
