#include <plexway/executors/serial_simplicial.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string>

#include <plexway/error.hpp>
#include <plexway/propagate/simplex_rule.hpp>
#include <plexway/propagate/wavefront.hpp>

#include "propagate/simplex_propagation.hpp"

namespace plexway {
namespace {

template <class Real, int N>
void check(const SimplicialComplex<Real, N>& domain, std::span<const PointSource> sources,
           const PropagateOptions& options) {
  if (sources.empty()) throw UsageError("there is no source: name at least one");
  if (sources.size() >= none) throw UsageError("too many sources");
  for (const PointSource& s : sources) {
    if (s.vertex != none) {
      if (s.vertex >= domain.vertex_count())
        throw UsageError("source vertex " + std::to_string(s.vertex) +
                         " is out of range, there are " + std::to_string(domain.vertex_count()));
    } else {
      if (s.simplex >= domain.simplex_count())
        throw UsageError("source simplex " + std::to_string(s.simplex) +
                         " is out of range, there are " + std::to_string(domain.simplex_count()));
      if (N == 4)
        throw UsageError(
            "a source in four dimensions must be a vertex: a point of a 4-simplex has "
            "five coordinates");
      double sum = 0;
      bool inside = true;
      for (std::size_t i = 0; i < s.barycentric.size(); ++i) {
        const double b = s.barycentric[i];
        inside = inside && b >= 0 && (i <= N || b == 0);
        sum += b;
      }
      if (!inside || !(std::abs(sum - 1) < 1e-6))
        throw UsageError("a source's barycentric coordinates must be >= 0 and sum to 1, with " +
                         std::to_string(N + 1) + " entries that are not 0 at most");
    }
    if (!(s.offset >= 0) || !std::isfinite(s.offset))
      throw UsageError("a source's offset must be a number >= 0");
  }
  if (!(options.step > 0)) throw UsageError("the step must be > 0");
  if (!(options.radius >= 0)) throw UsageError("the radius must be >= 0");
}

// The least that the simplices at a vertex offer; then the sources and the corners of simplices
// they lie in, exactly.
template <class Real, int N, class Rule, class Front>
void read_out(const SimplicialComplex<Real, N>& domain, std::span<const PointSource> sources,
              const Rule& rule, const Front& front, Workspace<Real>& workspace) {
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

template <class Real, int N, class Queue>
void solve(const SimplicialComplex<Real, N>& domain, std::span<const PointSource> sources,
           const PropagateOptions& options, Workspace<Real>& workspace, Queue queue,
           DistanceField<Real>& field) {
  const std::size_t simplices = domain.simplex_count(), vertices = domain.vertex_count();
  workspace.marks.resize(simplices);
  workspace.marks.start();
  workspace.source.resize(simplices);
  using Front = Wavefront<Real, Queue, true>;
  using Rule = PlainSimplexRule<Real, N, Front>;
  Front front(workspace.marks, queue, workspace.source.data(), simplices, domain.unit(), options);
  const Rule rule(domain.records(), workspace.simplex.template reserve<N>(simplices), front,
                  options.visibility);
  SimplexPropagation<Real, N, Rule, Front> propagation(domain, rule, front, options);
  for (std::size_t n = 0; n < sources.size(); ++n)
    propagation.seed(sources[n], static_cast<Index>(n));
  propagation.run();
  read_out(domain, sources, rule, front, workspace);

  constexpr Real infinity = std::numeric_limits<Real>::infinity();
  const Real unit = static_cast<Real>(domain.unit()), radius = static_cast<Real>(options.radius);
  const std::span<const Index> inside = domain.vertices_inside();
  const bool labels = sources.size() > 1;
  field.distance.resize(vertices);
  field.label.resize(labels ? vertices : 0);
  for (std::size_t v = 0; v < vertices; ++v) {
    const Real d = workspace.vertex[inside[v]] * unit;
    const bool in = d <= radius && d < infinity;
    field.distance[v] = in ? d : infinity;
    if (labels) field.label[v] = in ? workspace.vertex_source[inside[v]] : none;
  }
  // An offset survives scaling exactly.
  for (const PointSource& s : sources)
    if (s.vertex != none && s.offset <= options.radius)
      field.distance[s.vertex] = std::min(field.distance[s.vertex], static_cast<Real>(s.offset));
  field.complete = !front.out_of_budget();
  field.statistics = {front.expansions(), front.updates(), front.reached_count()};
}

}  // namespace

template <class Real, int N>
void propagate(Serial, const SimplicialComplex<Real, N>& domain,
               std::span<const PointSource> sources, const PropagateOptions& options,
               Workspace<Real>& workspace, DistanceField<Real>& field) {
  check(domain, sources, options);
  workspace.front.reserve(domain.simplex_count());
  if (options.schedule == Schedule::priority) {
    solve(domain, sources, options, workspace, PriorityQueue<Real>(workspace.front), field);
    return;
  }
  const Real step = options.schedule == Schedule::fifo ? std::numeric_limits<Real>::infinity()
                                                       : static_cast<Real>(options.step);
  solve(domain, sources, options, workspace, DualQueue<Real>(workspace.front, step), field);
}

#define PLEXWAY_INSTANTIATE(Real, N)                                                               \
  template void propagate(Serial, const SimplicialComplex<Real, N>&, std::span<const PointSource>, \
                          const PropagateOptions&, Workspace<Real>&, DistanceField<Real>&);
PLEXWAY_INSTANTIATE(float, 1)
PLEXWAY_INSTANTIATE(float, 2)
PLEXWAY_INSTANTIATE(float, 3)
PLEXWAY_INSTANTIATE(float, 4)
PLEXWAY_INSTANTIATE(double, 1)
PLEXWAY_INSTANTIATE(double, 2)
PLEXWAY_INSTANTIATE(double, 3)
PLEXWAY_INSTANTIATE(double, 4)
#undef PLEXWAY_INSTANTIATE

}  // namespace plexway
