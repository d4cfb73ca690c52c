#include "any/fastest_executor.hpp"

#include <plexway/support.hpp>

namespace plexway {

AnyExecutor fastest_executor(const AnyDomain& domain, std::size_t sources,
                             const PropagateOptions& options, const OpenMP& team) {
  if (!openmp_built() || options.schedule == Schedule::priority) return Serial{};
  const bool triangles = domain.kind() == DomainKind::surface || domain.kind() == DomainKind::cloud;
  if (triangles &&
      resolved(options.accuracy, {.executor = ExecutorKind::serial,
                                  .domain = DomainKind::surface,
                                  .dimension = 2,
                                  .single_precision = true,
                                  .visibility = options.visibility}) != Accuracy::fast())
    return Serial{};  // windows are one thread's
  const bool bounded =
      options.radius < PropagateOptions{}.radius ||
      options.max_expansions < PropagateOptions{}.max_expansions;  // fronts may stay short
  if (domain.simplices() < auto_simplices || sources < auto_sources || bounded ||
      team_size(team) < 2)
    return Serial{};
  return team;
}

}  // namespace plexway
