#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <span>

#include <plexway/error.hpp>
#include <plexway/propagate/simplex_rule.hpp>
#include <plexway/propagate/wavefront.hpp>

#include "executors/checks.hpp"
#include "propagate/finish.hpp"
#include "propagate/simplex_propagation.hpp"

/// A solve on a complex of any dimension, for any crew.
namespace plexway::simplicial {

/// The least that the simplices at a vertex offer; then the sources and the corners of simplices
/// they lie in, exactly.
template <class Real, int N, class Rule, class Front, class Crew>
void read_out(const SimplicialComplex<Real, N>& domain, std::span<const PointSource> sources,
              const Rule& rule, const Front& front, const Crew& crew, Workspace<Real>& workspace) {
  workspace.vertex.assign(domain.vertex_count(), std::numeric_limits<Real>::infinity());
  workspace.vertex_source.assign(domain.vertex_count(), none);
  const auto offer = [&](Index v, Real d, Index number) {
    if (!(d < workspace.vertex[v])) return;
    workspace.vertex[v] = d;
    workspace.vertex_source[v] = number;
  };
  if constexpr (requires { crew.team(); }) {
    crew.over(domain.vertex_count(), [&](std::size_t begin, std::size_t end) {
      for (std::size_t v = begin; v < end; ++v)
        for (const Index c : domain.corners_at(static_cast<Index>(v)))
          if (const Index s = c / (N + 1); front.reached(s))
            offer(static_cast<Index>(v), rule.corner_distance(s, c % (N + 1)), front.source(s));
    });
  } else {
    for (Index s = 0; s < domain.simplex_count(); ++s)
      if (front.reached(s))
        for (std::size_t i = 0; i <= N; ++i)
          offer(domain.records()[s].corner[i], rule.corner_distance(s, i), front.source(s));
  }
  for (std::size_t n = 0; n < sources.size(); ++n) {
    const double sigma = sources[n].offset / domain.unit();
    const Index number = static_cast<Index>(n);
    if (sources[n].vertex != none) {
      offer(domain.inside_vertex(sources[n].vertex), static_cast<Real>(sigma), number);
      continue;
    }
    const Index s = domain.inside_simplex(sources[n].simplex);
    const std::array<double, N + 1> b = inside_coordinates(domain, s, sources[n]);
    const auto d2 = corner_distances2<Real, N>(domain.records()[s], b);
    for (std::size_t i = 0; i <= N; ++i)
      offer(domain.records()[s].corner[i],
            static_cast<Real>(b[i] == 1 ? sigma : sigma + std::sqrt(d2[i])), number);
  }
}

/// One solve with a queue of its own.
template <class Real, int N, class Queue, class Crew>
void solve(const SimplicialComplex<Real, N>& domain, std::span<const PointSource> sources,
           const PropagateOptions& options, Workspace<Real>& workspace, Queue queue,
           const Crew& crew, DistanceField<Real>& field) {
  const std::size_t simplices = domain.simplex_count();
  workspace.start(simplices, true);
  using Front = Wavefront<Real, SimplexLabel<Real, N>, Queue, true>;
  using Rule = PlainSimplexRule<Real, N, Front>;
  Front front(workspace.marks, workspace.simplex.template reserve<N>(simplices), queue,
              workspace.source.data(), simplices, domain.unit(), options);
  const Rule rule(domain.records().data(), front, options.visibility);
  SimplexPropagation<Real, N, Rule, Front> propagation(domain, rule, front, options);
  for (std::size_t n = 0; n < sources.size(); ++n)
    propagation.seed(sources[n], static_cast<Index>(n));
  crew.run(propagation, front, simplices);
  read_out(domain, sources, rule, front, crew, workspace);

  if (sources.size() > 1)
    finish<Real, true>(domain, sources, options, front, workspace, crew, field);
  else
    finish<Real, false>(domain, sources, options, front, workspace, crew, field);
}

}  // namespace plexway::simplicial
