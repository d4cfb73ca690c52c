#include "executors/checks.hpp"
#include "executors/drive.hpp"
#include "executors/run.hpp"
#include "executors/solve_simplicial.hpp"

namespace plexway {

template <class E, class Real, int N>
void solve_points(const E& executor, const SimplicialComplex<Real, N>& domain,
                  std::span<const PointSource> sources, const PropagateOptions& options,
                  Workspace<Real>& kept, DistanceField<Real>& field) {
  WorkspaceState<Real>& workspace = kept.state();
  check(sources, options, domain);
  drive<true>(executor, domain, sources, options, workspace,
              [&](auto queue, const auto& scheduler) {
                simplicial::solve(domain, sources, options, workspace, queue, scheduler, field);
              });
}

PLEXWAY_SIMPLICES(PLEXWAY_COMPILE_HERE)

}  // namespace plexway
