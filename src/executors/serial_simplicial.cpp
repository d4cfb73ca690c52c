#include <plexway/executors/serial_simplicial.hpp>

#include "executors/alone.hpp"
#include "executors/solve_simplicial.hpp"

namespace plexway {

template <class Real, int N>
void propagate(Serial, const SimplicialComplex<Real, N>& domain,
               std::span<const PointSource> sources, const PropagateOptions& options,
               Workspace<Real>& workspace, DistanceField<Real>& field) {
  simplicial::check_sources(domain, sources, options);
  workspace.front.reserve(domain.simplex_count());
  with_queue<Real>(options, workspace.front, [&](auto queue) {
    simplicial::solve(domain, sources, options, workspace, queue, Alone{}, field);
  });
}

#define PLEXWAY_INSTANTIATE(Real, N)                                                               \
  template void propagate(Serial, const SimplicialComplex<Real, N>&, std::span<const PointSource>, \
                          const PropagateOptions&, Workspace<Real>&, DistanceField<Real>&);
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
