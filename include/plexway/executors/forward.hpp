#pragma once

#include <span>

#include <plexway/solve.hpp>

// The names that `solve` and `solve_each` had before; to be gone with their last caller.
namespace plexway {

template <ExecutorType E, DomainType D>
void propagate(const E& executor, const D& domain, const SourceList& sources,
               const PropagateOptions& options, WorkspaceOf<E, D>& workspace,
               DistanceField<RealOf<D>>& field) {
  solve(executor, domain, sources, options, workspace, field);
}
template <ExecutorType E, DomainType D>
[[nodiscard]] DistanceField<RealOf<D>> propagate(const E& executor, const D& domain,
                                                 const SourceList& sources,
                                                 const PropagateOptions& options = {}) {
  return solve(executor, domain, sources, options);
}
template <ExecutorType E, DomainType D>
[[nodiscard]] DistanceField<RealOf<D>> field(const E& executor, const D& domain,
                                             const SourceList& sources,
                                             const PropagateOptions& options = {}) {
  return solve(executor, domain, sources, options);
}
template <ExecutorType E, DomainType D>
[[nodiscard]] Fields<RealOf<D>> fields(const E& executor, const D& domain,
                                       const SourceList& sources,
                                       const PropagateOptions& options = {}) {
  return solve_each(executor, domain, sources, options);
}
template <ExecutorType E, DomainType D>
bool propagate_each(const E& executor, const D& domain, const SourceList& sources,
                    const PropagateOptions& options, WorkspaceOf<E, D>& workspace,
                    std::span<RealOf<D>> distance) {
  return solve_each(executor, domain, sources, options, workspace, distance);
}

namespace detail {
using plexway::team_size;
}

}  // namespace plexway
