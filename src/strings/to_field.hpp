#pragma once

#include <algorithm>
#include <cstddef>
#include <limits>
#include <span>

#include <plexway/error.hpp>
#include <plexway/solve/distance_field.hpp>
#include <plexway/solve/options.hpp>
#include <plexway/source/point_source.hpp>

#include "strings/labels.hpp"

/// Between strings and the library's options and fields.
namespace plexway::detail::strings {

/// Of a solve in a domain of so many simplices, in units; its progress throws Cancelled. As long as
/// the options.
inline Limits limits_of(const PropagateOptions& options, double unit, std::size_t simplices,
                        const Threads& threads = {}) {
  Limits limits{options.radius / unit, options.max_expansions, {}, threads};
  if (options.progress)
    limits.progress = [&options, unit, simplices](std::size_t expansions, double distance) {
      if (!options.progress(
              {expansions, std::min(expansions, simplices), simplices, distance * unit}))
        throw Cancelled("cancelled by the progress callback");
    };
  return limits;
}

/// What a solver found of so many vertices, by the caller's numbers and unit; `number(vertex)` is
/// the solver's.
template <class Solver, class Number, class Real>
void to_field(const Solver& solver, std::size_t vertices, const Number& number, double unit,
              std::span<const PointSource> sources, double radius, DistanceField<Real>& field) {
  constexpr Real unreached = std::numeric_limits<Real>::infinity();
  field.distance.resize(vertices);
  field.label.assign(sources.size() > 1 ? vertices : 0, none);
  for (Index v = 0; v < vertices; ++v) {
    const Real d = static_cast<Real>(solver.distance(number(v)) * unit);
    const bool in = d <= static_cast<Real>(radius) && d < unreached;
    field.distance[v] = in ? d : unreached;
    if (in && sources.size() > 1) field.label[v] = solver.source(number(v));
  }
  // An offset survives scaling exactly, and a vertex that no simplex has is a source all the same.
  for (Index n = 0; n < sources.size(); ++n) {
    const PointSource& s = sources[n];
    const Real offset = static_cast<Real>(s.offset);
    if (s.vertex == none || s.offset > radius || !(offset < field.distance[s.vertex])) continue;
    field.distance[s.vertex] = offset;
    if (sources.size() > 1) field.label[s.vertex] = n;
  }
  field.error.clear();
  field.statistics = {};
  field.statistics.expansions = solver.counts().expansions;
  field.statistics.updates = solver.counts().labels;
}

}  // namespace plexway::detail::strings
