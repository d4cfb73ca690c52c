#pragma once

#include <limits>
#include <span>
#include <type_traits>

#include <plexway/error.hpp>

#include "propagate/finish.hpp"
#include "propagate/plain_solid_rule.hpp"
#include "propagate/solid_borders.hpp"
#include "propagate/solid_propagation.hpp"
#include "propagate/solid_read_out.hpp"
#include "propagate/solid_rule.hpp"

/// A solve in a solid, for any crew.
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

/// Between the cells of several sources.
template <class Real, class Rule, class Front>
void read_out_borders(const TetMesh<Real>& mesh, std::span<const PointSource> sources,
                      const PropagateOptions& options, WorkspaceState<Real>& workspace,
                      const Rule& rule, const Front& front) {
  const auto tetrahedron = [&](Index v) { return workspace.vertex_tet[v]; };
  SolidBorders(mesh, rule, front, workspace, options, tetrahedron).run(sources);
}

template <class Real, bool kLabels, class Rule, class Front, class Crew>
void solve(const TetMesh<Real>& mesh, std::span<const PointSource> sources,
           const PropagateOptions& options, WorkspaceState<Real>& workspace, const Rule& rule,
           Front& front, const Crew& crew, DistanceField<Real>& field) {
  SolidPropagation<Real, Rule, Front> propagation(mesh, rule, front, options);
  for (std::size_t n = 0; n < sources.size(); ++n)
    propagation.seed(sources[n], static_cast<Index>(n));
  crew.run(propagation, front, mesh.tet_count());

  if constexpr (requires { crew.team(); }) {
    const std::size_t vertices = mesh.vertex_count();
    start_read_out<kLabels>(vertices, workspace);
    crew.over(vertices, [&](std::size_t begin, std::size_t end) {
      read_out_around<Real, kLabels>(mesh, rule, front, static_cast<Index>(begin),
                                     static_cast<Index>(end), workspace);
    });
  } else {
    read_out<Real, kLabels>(mesh, rule, front, workspace);
  }
  read_out_sources<Real, kLabels>(mesh, sources, workspace);
  constexpr bool plain = std::is_same_v<Rule, PlainSolidRule<Real, Front>>;
  if constexpr (kLabels && !plain)
    if (sources.size() > 1 && !front.out_of_budget())
      read_out_borders(mesh, sources, options, workspace, rule, front);
  // The full rule is exact where nothing bends a path.
  if (plain || rule.drops())
    read_out_tet_edges<Real, kLabels>(mesh, workspace, [&](const auto& wrong, const auto& look) {
      crew.search(mesh.tet_count(), wrong, look);
    });

  finish<Real, kLabels>(mesh, sources, options, front, workspace, crew, field);
}

/// One solve with a queue of its own: rule and labels by the policy, the rest by the crew.
template <class Real, bool kLabels, class Queue, class Crew>
void solve_with(const TetMesh<Real>& mesh, std::span<const PointSource> sources,
                const PropagateOptions& options, WorkspaceState<Real>& workspace, Queue queue,
                const Crew& crew, DistanceField<Real>& field) {
  workspace.start(mesh.tet_count(), kLabels);
  const std::size_t records = mesh.tet_count() + 1;
  const auto front = [&](auto* labels) {
    return Wavefront<Real, std::remove_pointer_t<decltype(labels)>, Queue, kLabels>(
        workspace.marks, labels, queue, workspace.source.data(), mesh.tet_count(), mesh.unit(),
        options);
  };
  if (mesh.embedded() && options.visibility == Visibility::saddles) {
    auto wave = front(workspace.solids.reserve(records));
    SolidRule<Real, decltype(wave)> rule(mesh, wave);
    thread_local SolidClearSpace<Real> clear;  // so that a second solve allocates nothing
    if (clear.identity() != mesh.identity()) clear.measure(mesh);
    rule.skip(clear);
    thread_local SolidObstacles<Real> obstacles;
    if (obstacles.identity() != mesh.identity()) obstacles.measure(mesh);
    rule.mind(obstacles);
    if constexpr (!requires { crew.team(); }) {
      if (!mesh.reflex_edges().empty()) {
        workspace.lit.start(mesh.tet_count());
        rule.keep_lit(workspace.lit);
      }
    }
    solve<Real, kLabels>(mesh, sources, options, workspace, rule, wave, crew, field);
  } else {
    auto wave = front(workspace.plain_solids.reserve(records));
    const PlainSolidRule<Real, decltype(wave)> rule(mesh, wave, options.visibility);
    solve<Real, kLabels>(mesh, sources, options, workspace, rule, wave, crew, field);
  }
}

}  // namespace plexway::solid
