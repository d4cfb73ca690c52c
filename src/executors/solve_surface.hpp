#pragma once

#include <algorithm>
#include <limits>
#include <span>
#include <type_traits>

#include "labels/finish.hpp"
#include "labels/plain_rule.hpp"
#include "labels/read_out.hpp"
#include "labels/surface/repair_surface.hpp"
#include "labels/surface/saddle_rule.hpp"
#include "labels/surface/triangle_propagation.hpp"

/// A solve on a surface, for any scheduler.
namespace plexway::detail::surface {
/// The sources themselves, exactly, and the corners of triangles they lie in. `numbers`: which they
/// are, ascending; empty for all.
template <class Real, bool kLabels>
void read_out_sources(const TriangleMesh<Real>& mesh, std::span<const PointSource> sources,
                      WorkspaceState<Real>& workspace, std::span<const Index> numbers = {}) {
  for (std::size_t n = sources.size(); n-- > 0;)
    offer_source(mesh, sources[n], [&](Index v, double d) {
      const auto distance = static_cast<Real>(d);
      if (!(distance < workspace.vertex[v]) && !(kLabels && distance == workspace.vertex[v]))
        return;
      workspace.vertex[v] = distance;
      if constexpr (kLabels)
        workspace.vertex_source[v] = numbers.empty() ? static_cast<Index>(n) : numbers[n];
    });
}

/// Nothing but points.
struct NoShapes {
  template <class Rule, class Front>
  void seed(const Rule&, Front&) const {}
  template <class Front>
  void read_out(const Front&) const {}
};

/// `shapes` seeds the labels with what is no point, and reads it out after the triangles.
template <class Real, bool kLabels, class Rule, class Front, class Scheduler,
          class Shapes = NoShapes>
void solve(const TriangleMesh<Real>& mesh, std::span<const PointSource> sources,
           const PropagateOptions& options, WorkspaceState<Real>& workspace, const Rule& rule,
           Front& front, const Scheduler& scheduler, DistanceField<Real>& field,
           const Shapes& shapes = {}) {
  TrianglePropagation<Real, Rule, Front, kLabels> propagation(mesh, workspace, rule, front,
                                                              options);
  for (std::size_t n = 0; n < sources.size(); ++n)
    propagation.seed(sources[n], static_cast<Index>(n));
  shapes.seed(rule, front);
  scheduler.run(propagation, front, mesh.face_count());

  constexpr Real unreached = std::numeric_limits<Real>::infinity();
  const std::size_t vertices = mesh.vertex_count();
  workspace.vertex.assign(vertices, unreached);
  if constexpr (kLabels) workspace.vertex_source.assign(vertices, none);
  if constexpr (requires { scheduler.read_out(workspace); })
    scheduler.read_out(workspace);
  else
    read_out_triangles<Real, kLabels>(mesh.triangles(), rule, front, workspace);
  if (mesh.summary().refracting_edges > 0)  // where lengths are no metric, light may gain on itself
    for (Real& d : workspace.vertex) d = std::max(d, Real(0));
  read_out_sources<Real, kLabels>(mesh, sources, workspace);
  shapes.read_out(front);
  Repaired repaired;
  if (options.visibility == Visibility::saddles) {
    constexpr bool points = std::is_same_v<Shapes, NoShapes>;
    repaired = repair<Real, kLabels>(mesh, points ? sources : std::span<const PointSource>(),
                                     workspace, scheduler);
  }

  // Without a radius, whole fans are reached or not; so one of its corners tells of a vertex,
  // unless fans only touch there.
  const bool bounded = options.radius < unreached || front.out_of_budget();
  for (Index v = 0; v < vertices; ++v)
    if (!(workspace.vertex[v] < unreached) && mesh.corner_at(v) != none &&
        (bounded || !mesh.pinched().empty() || front.reached(mesh.corner_at(v) / 3))) [[unlikely]]
      read_out_around<Real, kLabels>(mesh, rule, front, v, workspace);
  finish<Real, kLabels>(mesh, sources, options, front, workspace, scheduler, field);
  field.statistics.lowered_vertices = repaired.lowered;
  field.statistics.raised_vertices = repaired.raised;
}

/// One solve with a queue of its own: rule and labels by the policy, the rest by the scheduler.
template <class Real, bool kLabels, class Queue, class Scheduler>
void solve_with(const TriangleMesh<Real>& mesh, std::span<const PointSource> sources,
                const PropagateOptions& options, WorkspaceState<Real>& workspace, Queue queue,
                const Scheduler& scheduler, DistanceField<Real>& field) {
  workspace.start(mesh.face_count(), kLabels);
  const std::size_t records = mesh.face_count() + 1;
  const auto front = [&](auto* labels) {
    return Wavefront<Real, std::remove_pointer_t<decltype(labels)>, Queue, kLabels>(
        workspace.marks, labels, queue, workspace.source.data(), mesh.face_count(), mesh.unit(),
        options);
  };
  if (options.visibility == Visibility::saddles) {
    auto wave = front(workspace.saddles.reserve(records));
    const SaddleRule<Real, decltype(wave)> rule(mesh.triangles(), wave, options.vectorised);
    solve<Real, kLabels>(mesh, sources, options, workspace, rule, wave, scheduler, field);
  } else {
    auto wave = front(workspace.simplex.template reserve<2>(records));
    const PlainRule<Real, decltype(wave)> rule(mesh.triangles(), wave, options.visibility,
                                               options.probe);
    solve<Real, kLabels>(mesh, sources, options, workspace, rule, wave, scheduler, field);
  }
}

}  // namespace plexway::detail::surface
