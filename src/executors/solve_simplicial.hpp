#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <span>
#include <vector>

#include <plexway/error.hpp>

#include "executors/checks.hpp"
#include "labels/changed_vertices.hpp"
#include "labels/finish.hpp"
#include "labels/simplicial/simplex_propagation.hpp"
#include "labels/simplicial/simplex_rule.hpp"
#include "labels/wavefront.hpp"

/// A solve on a complex of any dimension, for any scheduler.
namespace plexway::simplicial {

/// The least that the simplices at a vertex offer; then the sources and the corners of simplices
/// they lie in, exactly.
template <class Real, int N, class Rule, class Front>
void read_out(const SimplicialComplex<Real, N>& domain, std::span<const PointSource> sources,
              const Rule& rule, const Front& front, WorkspaceState<Real>& workspace) {
  workspace.vertex.assign(domain.vertex_count(), std::numeric_limits<Real>::infinity());
  workspace.vertex_source.assign(domain.vertex_count(), none);
  const auto offer = [&](Index v, Real d, Index number) {
    if (!(d < workspace.vertex[v])) return;
    workspace.vertex[v] = d;
    workspace.vertex_source[v] = number;
  };
  for (Index s = 0; s < domain.simplex_count(); ++s)
    if (front.reached(s))
      for (std::size_t i = 0; i <= N; ++i)
        offer(domain.records()[s].corner[i], rule.corner_distance(s, i), front.source(s));
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

/// No vertex is farther than a neighbour and the edge between: where one came out so, it is given
/// that way, and what lies behind it. Cost: one look at all edges.
template <class Real, int N>
void relax_edges(const SimplicialComplex<Real, N>& domain, WorkspaceState<Real>& workspace) {
  ChangedVertices changed(workspace.front);
  const auto relax = [&](const auto& record, std::size_t i, std::size_t j) {
    Index v = record.corner[i], w = record.corner[j];
    const Real length2 = record.length2[SimplexLayout<N>::edge(i, j)];
    const Real rise = workspace.vertex[w] - workspace.vertex[v];
    if (rise * rise <= length2) [[likely]]
      return;
    if (rise < 0) std::swap(v, w);
    const Real by = workspace.vertex[v] + std::sqrt(length2);
    if (!(by < workspace.vertex[w])) return;  // nor where neither is reached
    // A search that ends early does not go on here.
    if (workspace.vertex[w] == std::numeric_limits<Real>::infinity()) return;
    workspace.vertex[w] = by;
    workspace.vertex_source[w] = workspace.vertex_source[v];
    changed.push(w);
  };
  do {
    changed.clear();
    for (const auto& record : domain.records())
      for (std::size_t j = 1; j <= N; ++j)
        for (std::size_t i = 0; i < j; ++i) relax(record, i, j);
    for (Index v = 0; changed.pop(v);)
      for (const Index c : domain.corners_at(v))
        for (std::size_t j = 0; j <= N; ++j)
          if (j != c % (N + 1)) relax(domain.records()[c / (N + 1)], c % (N + 1), j);
  } while (changed.lost());
}

/// No path is shorter than the straight line between its ends, whatever the complex does in
/// between. Where two simplices lie on one side of the facet that they share, a source unfolded
/// over it is a mirror image, and the plain step, which judges a line of sight by centres, may
/// measure to it past the facet: such a distance can only be wrong, and gets the line's length,
/// which is nearer to the truth. Returns how many were below it by more than 1e-4. Cost: the
/// coordinates of all vertices, times all sources.
template <class Real, int N>
std::size_t raise_to_lines(const SimplicialComplex<Real, N>& domain,
                           std::span<const PointSource> sources, WorkspaceState<Real>& workspace) {
  const std::size_t axes = workspace.vertex.empty() ? 0 : domain.coordinates(0).size();
  if (axes == 0) return 0;
  std::vector<double> from(axes * sources.size(), 0);
  for (std::size_t n = 0; n < sources.size(); ++n) {
    const auto add = [&](Index v, double weight) {
      for (std::size_t d = 0; d < axes; ++d)
        from[axes * n + d] += weight * domain.coordinates(v)[d];
    };
    if (sources[n].vertex != none) {
      add(domain.inside_vertex(sources[n].vertex), 1);
      continue;
    }
    const Index s = domain.inside_simplex(sources[n].simplex);
    const std::array<double, N + 1> b = inside_coordinates(domain, s, sources[n]);
    for (std::size_t i = 0; i <= N; ++i) add(domain.records()[s].corner[i], b[i]);
  }
  const auto line = [&](std::span<const double> to, std::size_t n) {
    double sum = 0;
    for (std::size_t d = 0; d < axes; ++d)
      sum += (to[d] - from[axes * n + d]) * (to[d] - from[axes * n + d]);
    return sources[n].offset / domain.unit() + std::sqrt(sum);
  };
  // By more than rounding.
  constexpr double slack = 1 - 64 * static_cast<double>(std::numeric_limits<Real>::epsilon());
  std::size_t raised = 0;
  for (std::size_t v = 0; v < workspace.vertex.size(); ++v) {
    Real& d = workspace.vertex[v];
    if (!(d < std::numeric_limits<Real>::infinity())) continue;
    const auto to = domain.coordinates(static_cast<Index>(v));
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t n = 0; n < sources.size() && static_cast<double>(d) < slack * least; ++n)
      least = std::min(least, line(to, n));
    if (!(static_cast<double>(d) < slack * least)) continue;
    raised += static_cast<double>(d) < least * (1 - 1e-4);
    d = static_cast<Real>(least);
  }
  return raised;
}

/// One solve by the plain step, with a queue of its own.
template <class Real, int N, class Queue, class Scheduler>
void solve(const SimplicialComplex<Real, N>& domain, std::span<const PointSource> sources,
           const PropagateOptions& options, WorkspaceState<Real>& workspace, Queue queue,
           const Scheduler& scheduler, DistanceField<Real>& field) {
  const std::size_t simplices = domain.simplex_count();
  workspace.start(simplices, true);
  using Front = Wavefront<Real, SimplexLabel<Real, N>, Queue, true>;
  Front front(workspace.marks, workspace.simplex.template reserve<N>(simplices), queue,
              workspace.source.data(), simplices, domain.unit(), options);
  const PlainSimplexRule<Real, N, Front> rule(domain.records().data(), front, options.visibility);
  SimplexPropagation<Real, N, PlainSimplexRule<Real, N, Front>, Front> propagation(domain, rule,
                                                                                   front, options);
  for (std::size_t n = 0; n < sources.size(); ++n)
    propagation.seed(sources[n], static_cast<Index>(n));
  scheduler.run(propagation, front, simplices);
  read_out(domain, sources, rule, front, workspace);
  // The policies that study the step itself show it as it is, on surfaces too.
  std::size_t raised = 0;
  if (options.visibility == Visibility::saddles) {
    relax_edges(domain, workspace);
    raised = raise_to_lines(domain, sources, workspace);
  }
  if (sources.size() > 1)
    finish<Real, true>(domain, sources, options, front, workspace, scheduler, field);
  else
    finish<Real, false>(domain, sources, options, front, workspace, scheduler, field);
  field.statistics.raised_vertices = raised;
}

}  // namespace plexway::simplicial
