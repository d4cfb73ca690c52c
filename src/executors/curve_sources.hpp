#pragma once

#include <span>

#include <plexway/executors.hpp>
#include <plexway/solve/distance_field.hpp>
#include <plexway/solve/options.hpp>
#include <plexway/solve/workspace.hpp>
#include <plexway/surface/triangle_mesh.hpp>

#include "executors/source_parts.hpp"

namespace plexway::detail {

/// Points and shapes on a surface, as one field: by windows, or by the labels of one thread in
/// double.
template <class E, class Real>
void solve_shapes(const E& executor, const TriangleMesh<Real>& mesh,
                  std::span<const Source> sources, SourceParts& parts,
                  const PropagateOptions& options, Workspace<Real>& workspace,
                  DistanceField<Real>& field);

}  // namespace plexway::detail
