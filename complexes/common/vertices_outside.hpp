#pragma once

#include <span>
#include <vector>

#include <plexway/common/ids.hpp>

namespace plexway::detail {

/// The caller's number of each vertex of a domain, by its number inside.
template <class Domain>
std::vector<Index> vertices_outside(const Domain& domain) {
  const std::span<const Index> inside = domain.vertices_inside();
  std::vector<Index> outside(inside.size());
  for (Index v = 0; v < inside.size(); ++v) outside[inside[v]] = v;
  return outside;
}

}  // namespace plexway::detail
