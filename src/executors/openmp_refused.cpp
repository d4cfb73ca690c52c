#include <plexway/executors/openmp.hpp>

#include <string>

#include <plexway/error.hpp>

#include "executors/team.hpp"

// What a team does not propagate on.

namespace plexway {
namespace {

[[noreturn]] void refuse(const OpenMP& executor, const char* domains) {
  const Team team(executor);  // its own complaints first
  throw UsageError(std::string(domains) +
                   " are not propagated on by several threads: use the executor Serial, or fields, "
                   "which takes one thread a source");
}

}  // namespace

template <class Real>
void propagate(const OpenMP& executor, const MixedComplex<Real>&, std::span<const PointSource>,
               const PropagateOptions&, MixedWorkspace<Real>&, DistanceField<Real>&) {
  refuse(executor, "mixed domains");
}

template void propagate(const OpenMP&, const MixedComplex<float>&, std::span<const PointSource>,
                        const PropagateOptions&, MixedWorkspace<float>&, DistanceField<float>&);
template void propagate(const OpenMP&, const MixedComplex<double>&, std::span<const PointSource>,
                        const PropagateOptions&, MixedWorkspace<double>&, DistanceField<double>&);

}  // namespace plexway
