// On the cloud's triangles, by the loops of surface.cpp.

#include "executors/cloud_field.hpp"
#include "executors/run.hpp"

namespace plexway {
using namespace detail;

#define PLEXWAY_SHEETS(...)              \
  PLEXWAY_ELSEWHERE(Serial, __VA_ARGS__) \
  PLEXWAY_ELSEWHERE(OpenMP, __VA_ARGS__)
PLEXWAY_SURFACES(PLEXWAY_SHEETS)
#undef PLEXWAY_SHEETS

template <class E, class Real>
void solve_points(const E& executor, const PointCloud<Real>& cloud,
                  std::span<const PointSource> sources, const PropagateOptions& options,
                  Workspace<Real>& workspace, DistanceField<Real>& field) {
  solve_on_cloud(executor, cloud, sources, options, workspace.state().moved, workspace, field);
}

PLEXWAY_CLOUDS(PLEXWAY_COMPILE_HERE)

}  // namespace plexway
