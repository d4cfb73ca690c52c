#pragma once

#include <span>
#include <vector>

#include <plexway/executors.hpp>
#include <plexway/solve/distance_field.hpp>
#include <plexway/solve/options.hpp>
#include <plexway/solve/workspace.hpp>
#include <plexway/source/source.hpp>
#include <plexway/surface/triangle_mesh.hpp>

namespace plexway::detail {

/// What sources come down to.
struct SourceParts {
  std::vector<PointSource> points;
  std::vector<Index> owner;  ///< of each point: a place in the list of sources
  struct Ball {
    PointSource centre;
    double radius, offset;
    Index owner;
  };
  std::vector<Ball> balls;
  std::vector<Index> shapes;  ///< curves and simplices
};

/// Throws UsageError for no source, an empty one, and an offset or radius below 0. `edges_only`: in
/// a wireframe curves and edges are as near as their points.
[[nodiscard]] SourceParts take_apart(std::span<const Source> sources, bool edges_only);

/// Points and shapes on a surface, as one field: by windows, or by the labels of one thread in
/// double.
template <class E, class Real>
void solve_shapes(const E& executor, const TriangleMesh<Real>& mesh,
                  std::span<const Source> sources, SourceParts& parts,
                  const PropagateOptions& options, Workspace<Real>& workspace,
                  DistanceField<Real>& field);

}  // namespace plexway::detail
