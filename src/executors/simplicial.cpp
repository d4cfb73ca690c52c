// The loop: labels/simplicial/simplex_propagation.hpp. Flat complexes have those of surface.cpp,
// solid.cpp and strings/flat/flat_solver.hpp.

#include "executors/checks.hpp"
#include "executors/run.hpp"
#include "executors/solve_simplices.hpp"
#include "strings/flat/flat_strings.hpp"

namespace plexway {
using namespace detail;

PLEXWAY_ELSEWHERE(Serial, TriangleMesh<double>)
PLEXWAY_ELSEWHERE(Serial, TetMesh<double>)

namespace {

/// As the surface or the solid that a flat complex of two or three dimensions is. By one thread;
/// `solve_each` takes one a source.
template <class Real, class Mesh>
void solve_as(const Mesh& mesh, std::span<const PointSource> sources,
              const PropagateOptions& options, WorkspaceState<Real>& workspace,
              DistanceField<Real>& field) {
  PropagateOptions exactly = options;
  exactly.accuracy = Mesh::dimension == 2 ? Accuracy::exact() : Accuracy::accurate();
  exactly.schedule = Schedule::dual_queue;
  exactly.step = PropagateOptions().step;
  exactly.vectorised = true;
  if (!workspace.flat) workspace.flat = std::make_shared<FlatSolve>();
  DistanceField<double>& found = workspace.flat->field;
  solve(Serial{}, mesh, sources, exactly, workspace.flat->workspace, found);
  field.distance.assign(found.distance.begin(), found.distance.end());
  field.label = found.label;
  field.statistics = found.statistics;
  field.complete = found.complete;
}

}  // namespace

template <class E, class Real, int N>
void solve_points(const E& executor, const SimplicialComplex<Real, N>& domain,
                  std::span<const PointSource> sources, const PropagateOptions& options,
                  Workspace<Real>& kept, DistanceField<Real>& field) {
  WorkspaceState<Real>& workspace = kept.state();
  check(sources, options, domain);
  if constexpr (N > 1)
    if (options.visibility == Visibility::saddles && domain.flat()) {
      if constexpr (E::kind == ExecutorKind::openmp) const Team team(executor);  // may refuse
      if constexpr (N < 4) {
        solve_as(*domain.flat(), sources, options, workspace, field);
      } else {
        if (!workspace.flat_strings) workspace.flat_strings = std::make_shared<FlatStrings>();
        workspace.flat_strings->solve(domain, sources, options, field);
      }
      return;
    }
  solve_simplices(executor, domain, sources, options, workspace, field);
}

PLEXWAY_SIMPLICES(PLEXWAY_COMPILE_HERE)

}  // namespace plexway
