#pragma once

#include <limits>
#include <span>
#include <type_traits>

#include <plexway/error.hpp>

#include "labels/finish.hpp"
#include "labels/solid/plain_solid_rule.hpp"
#include "labels/solid/solid_propagation.hpp"
#include "labels/solid/solid_read_out.hpp"

/// A solve in a solid by the plain step, for any scheduler.
namespace plexway::solid {

/// The sources themselves, exactly, and the corners of tetrahedra they lie in.
template <class Real, bool kLabels>
void read_out_sources(const TetMesh<Real>& mesh, std::span<const PointSource> sources,
                      WorkspaceState<Real>& workspace) {
  for (std::size_t n = sources.size(); n-- > 0;)
    offer_corners(mesh, sources[n], [&](Index v, double d) {
      const Real distance = static_cast<Real>(d);
      if (distance > workspace.vertex[v]) return;
      workspace.vertex[v] = distance;
      if constexpr (kLabels) workspace.vertex_source[v] = static_cast<Index>(n);
    });
}

template <class Real, bool kLabels, class Rule, class Front, class Scheduler>
void solve(const TetMesh<Real>& mesh, std::span<const PointSource> sources,
           const PropagateOptions& options, WorkspaceState<Real>& workspace, const Rule& rule,
           Front& front, const Scheduler& scheduler, DistanceField<Real>& field) {
  SolidPropagation<Real, Rule, Front> propagation(mesh, rule, front, options);
  for (std::size_t n = 0; n < sources.size(); ++n)
    propagation.seed(sources[n], static_cast<Index>(n));
  scheduler.run(propagation, front, mesh.tet_count());

  if constexpr (requires { scheduler.team(); }) {
    const std::size_t vertices = mesh.vertex_count();
    start_read_out<kLabels>(vertices, workspace);
    scheduler.over(vertices, [&](std::size_t begin, std::size_t end) {
      read_out_around<Real, kLabels>(mesh, rule, front, static_cast<Index>(begin),
                                     static_cast<Index>(end), workspace);
    });
  } else {
    read_out<Real, kLabels>(mesh, rule, front, workspace);
  }
  read_out_sources<Real, kLabels>(mesh, sources, workspace);
  read_out_tet_edges<Real, kLabels>(mesh, workspace, [&](const auto& wrong, const auto& look) {
    scheduler.search(mesh.tet_count(), wrong, look);
  });

  finish<Real, kLabels>(mesh, sources, options, front, workspace, scheduler, field);
}

/// One solve with a queue of its own.
template <class Real, bool kLabels, class Queue, class Scheduler>
void solve_with(const TetMesh<Real>& mesh, std::span<const PointSource> sources,
                const PropagateOptions& options, WorkspaceState<Real>& workspace, Queue queue,
                const Scheduler& scheduler, DistanceField<Real>& field) {
  workspace.start(mesh.tet_count(), kLabels);
  const std::size_t records = mesh.tet_count() + 1;
  Wavefront<Real, PlainSolidLabel<Real>, Queue, kLabels> wave(
      workspace.marks, workspace.plain_solids.reserve(records), queue, workspace.source.data(),
      mesh.tet_count(), mesh.unit(), options);
  const PlainSolidRule<Real, decltype(wave)> rule(mesh, wave, options.visibility);
  solve<Real, kLabels>(mesh, sources, options, workspace, rule, wave, scheduler, field);
}

}  // namespace plexway::solid
