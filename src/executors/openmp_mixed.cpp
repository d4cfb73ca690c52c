#include <plexway/executors/openmp.hpp>

#include <plexway/error.hpp>

#include "executors/team.hpp"

namespace plexway {

template <class Real>
void propagate(const OpenMP& executor, const MixedComplex<Real>&, std::span<const PointSource>,
               const PropagateOptions&, MixedWorkspace<Real>&, DistanceField<Real>&) {
  const Team team(executor);
  throw UsageError(
      "mixed domains are not propagated on by several threads: use the executor Serial, or fields, "
      "which takes one thread a source");
}

template void propagate(const OpenMP&, const MixedComplex<float>&, std::span<const PointSource>,
                        const PropagateOptions&, MixedWorkspace<float>&, DistanceField<float>&);
template void propagate(const OpenMP&, const MixedComplex<double>&, std::span<const PointSource>,
                        const PropagateOptions&, MixedWorkspace<double>&, DistanceField<double>&);

}  // namespace plexway
