// The loops: strings::Solver::add (strings/solver.cpp), whose work is Extender::expand
// (strings/extender.cpp), and for `fast` that of labels/simplicial/simplex_propagation.hpp.

#include "executors/checks.hpp"
#include "executors/run.hpp"
#include "executors/solve_simplices.hpp"
#include "executors/threads/share_strings.hpp"
#include "strings/solid_strings.hpp"

namespace plexway {
using namespace detail;

template <class E, class Real>
void solve_points(const E& executor, const TetMesh<Real>& mesh,
                  std::span<const PointSource> sources, const PropagateOptions& options,
                  Workspace<Real>& kept, DistanceField<Real>& field) {
  WorkspaceState<Real>& workspace = kept.state();
  check(sources, options, mesh);
  const Accuracy accuracy =
      resolved(options.accuracy, with(combination<E, TetMesh<Real>>(), mesh.metric(), options));
  if (accuracy != Accuracy::fast()) {
    if (!workspace.strings) workspace.strings = std::make_shared<SolidStrings>();
    share_strings(executor, mesh.vertex_count(), [&](const strings::Threads& threads) {
      workspace.strings->solve(mesh, sources, options, threads, field);
    });
    return;
  }
  workspace.pieces.counts().start();
  solve_simplices(executor, mesh, sources, options, workspace, field);
  workspace.pieces.counts().tell(field.statistics);
}

PLEXWAY_SOLIDS(PLEXWAY_COMPILE_HERE)

}  // namespace plexway
