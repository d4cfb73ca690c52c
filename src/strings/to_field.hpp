#pragma once

#include <algorithm>
#include <cstddef>
#include <limits>
#include <span>

#include <plexway/error.hpp>
#include <plexway/solve/distance_field.hpp>
#include <plexway/solve/options.hpp>
#include <plexway/source/point_source.hpp>

/// Between strings and the library's options and fields.
namespace plexway::strings {

/// Reports how far strings are, in a domain of so many simplices; throws Cancelled.
inline void report(const PropagateOptions& options, std::size_t expansions, std::size_t simplices,
                   double distance) {
  if (options.progress &&
      !options.progress({expansions, std::min(expansions, simplices), simplices, distance}))
    throw Cancelled("cancelled by the progress callback");
}

/// What a solver found, by the caller's vertices and in the domain's unit.
template <class Domain, class Solver, class Real>
void to_field(const Domain& domain, const Solver& solver, std::span<const PointSource> sources,
              double radius, DistanceField<Real>& field) {
  constexpr Real infinity = std::numeric_limits<Real>::infinity();
  const std::size_t vertices = domain.vertex_count();
  field.distance.resize(vertices);
  field.label.assign(sources.size() > 1 ? vertices : 0, none);
  for (std::size_t v = 0; v < vertices; ++v) {
    const Index inside = domain.inside_vertex(static_cast<Index>(v));
    const Real d = static_cast<Real>(solver.distance(inside) * domain.unit());
    const bool in = d <= static_cast<Real>(radius) && d < infinity;
    field.distance[v] = in ? d : infinity;
    if (in && sources.size() > 1) field.label[v] = solver.source(inside);
  }
  // An offset survives scaling exactly.
  for (const PointSource& s : sources)
    if (s.vertex != none && s.offset <= radius)
      field.distance[s.vertex] = std::min(field.distance[s.vertex], static_cast<Real>(s.offset));
  field.error.clear();
  field.statistics = {};
}

}  // namespace plexway::strings
