#pragma once

#include <span>

#include "executors/threads/team.hpp"
#include "labels/alone.hpp"
#include "labels/finish.hpp"
#include "labels/simplicial/simplex_propagation.hpp"
#include "labels/simplicial/simplex_read_out.hpp"
#include "labels/wavefront.hpp"

namespace plexway::detail {

/// A solve in a solid or on a complex of any dimension by the plain step. By one thread, whatever
/// the executor; `solve_each` takes one a source.
template <class E, class Domain, class Real>
void solve_simplices(const E& executor, const Domain& domain, std::span<const PointSource> sources,
                     const PropagateOptions& options, WorkspaceState<Real>& workspace,
                     DistanceField<Real>& field) {
  if constexpr (E::kind == ExecutorKind::openmp) const Team team(executor);  // may refuse
  constexpr int N = SimplexCells<Domain>::N;
  const std::size_t simplices = domain.simplex_count();
  workspace.front.reserve(simplices);
  workspace.start(simplices, true);
  using Front = Wavefront<Real, SimplexLabel<Real, N>, ChosenQueue<Real>, true>;
  Front front(workspace.marks, workspace.simplex.template reserve<N>(simplices + 1),
              queue_for<Real>(options, workspace.front), workspace.source.data(), simplices,
              domain.unit(), options);
  SimplexPropagation<Domain, Front> propagation(domain, front, options);
  for (std::size_t n = 0; n < sources.size(); ++n)
    propagation.seed(sources[n], static_cast<Index>(n));
  propagation.run();
  read_out_simplices(domain, sources, propagation.rule(), front, workspace);
  // On complexes the policies that study the step itself show it as it is, as on surfaces.
  std::size_t raised = 0;
  if (Domain::kind == DomainKind::solid || options.visibility == Visibility::saddles) {
    relax_edges(domain, workspace);
    if constexpr (requires { domain.coordinates(0); })
      raised = raise_to_lines(domain, sources, workspace);
  }
  finish<Real, true>(domain, sources, options, front, workspace, Alone{}, field);
  if (sources.size() == 1) field.label.clear();
  field.statistics.raised_vertices = raised;
}

}  // namespace plexway::detail
