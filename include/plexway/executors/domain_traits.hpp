#pragma once

#include <cstddef>

#include <plexway/executors/serial_mixed.hpp>
#include <plexway/propagate/workspace.hpp>

namespace plexway {

namespace detail {

template <class Domain>
struct DomainTraits;
template <template <class> class Domain, class R>
struct DomainTraits<Domain<R>> {
  using Real = R;
  using Workspace = plexway::Workspace<R>;
};
template <template <class, int> class Domain, class R, int N>
struct DomainTraits<Domain<R, N>> {
  using Real = R;
  using Workspace = plexway::Workspace<R>;
};
template <class R>
struct DomainTraits<MixedComplex<R>> {
  using Real = R;
  using Workspace = MixedWorkspace<R>;
};

/// Distances in a field: a domain has vertices or points.
template <class Domain>
[[nodiscard]] std::size_t field_size(const Domain& domain) {
  if constexpr (requires { domain.vertex_count(); })
    return domain.vertex_count();
  else
    return domain.point_count();
}

}  // namespace detail

/// The number type of a domain, and what a propagation on it works with.
template <class Domain>
using RealOf = typename detail::DomainTraits<Domain>::Real;
template <class Domain>
using WorkspaceOf = typename detail::DomainTraits<Domain>::Workspace;

}  // namespace plexway
