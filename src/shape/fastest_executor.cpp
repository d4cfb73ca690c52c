#include "shape/fastest_executor.hpp"

#include <plexway/support.hpp>

namespace plexway {

AnyExecutor fastest_executor(const AnyDomain& domain, std::size_t sources,
                             const PropagateOptions& options, const OpenMP& team) {
  if (!openmp_built() || options.schedule == Schedule::priority) return Serial{};
  const bool in_pieces = domain.kind() == DomainKind::surface ||
                         domain.kind() == DomainKind::cloud || domain.kind() == DomainKind::solid ||
                         domain.kind() == DomainKind::wireframe;
  const bool bounded =
      options.radius < PropagateOptions{}.radius ||
      options.max_expansions < PropagateOptions{}.max_expansions;  // fronts may stay short
  const bool pays = in_pieces && domain.simplices() >= auto_in_pieces;
  const bool many = domain.simplices() >= auto_simplices && sources >= auto_sources;
  if (!(pays || many) || bounded || team_size(team) < 2) return Serial{};
  // A solid of several speeds is a mixed domain, and several threads are not for all options.
  if (!domain.support(team, PointSource::at(0), options)) return Serial{};
  return team;
}

}  // namespace plexway
