#include <plexway/executors/openmp.hpp>

#include "executors/crew.hpp"
#include "executors/solve_simplicial.hpp"
#include "executors/unordered.hpp"

namespace plexway {

template <class Real, int N>
void propagate(const OpenMP& executor, const SimplicialComplex<Real, N>& domain,
               std::span<const PointSource> sources, const PropagateOptions& options,
               Workspace<Real>& workspace, DistanceField<Real>& field) {
  const Team team(executor);
  simplicial::check_sources(domain, sources, options);
  check_unordered(sources, options);
  workspace.front.reserve(domain.simplex_count());
  const DualQueue<Real> queue(workspace.front, std::numeric_limits<Real>::infinity());
  const TeamCrew<Real, true> crew(team, workspace, step_of<Real>(options), domain.unit(), options);
  simplicial::solve(domain, sources, options, workspace, queue, crew, field);
}

#define PLEXWAY_INSTANTIATE(Real, N)                                                               \
  template void propagate(const OpenMP&, const SimplicialComplex<Real, N>&,                        \
                          std::span<const PointSource>, const PropagateOptions&, Workspace<Real>&, \
                          DistanceField<Real>&);
PLEXWAY_INSTANTIATE(float, 1)
PLEXWAY_INSTANTIATE(float, 2)
PLEXWAY_INSTANTIATE(float, 3)
PLEXWAY_INSTANTIATE(float, 4)
PLEXWAY_INSTANTIATE(double, 1)
PLEXWAY_INSTANTIATE(double, 2)
PLEXWAY_INSTANTIATE(double, 3)
PLEXWAY_INSTANTIATE(double, 4)
#undef PLEXWAY_INSTANTIATE

}  // namespace plexway
