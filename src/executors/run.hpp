#pragma once

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstddef>
#include <limits>
#include <span>

#include <plexway/solve.hpp>

#include "executors/checks.hpp"
#include "executors/same_work.hpp"
#include "executors/sources.hpp"
#include "executors/threads/share_out.hpp"
#include "labels/workspace_state.hpp"

/// From sources of any kind to points, for every executor and domain. Who includes this has
/// declared before, for its domains:
///
///   void solve_points(executor, domain, span of PointSource, options, workspace, field);
namespace plexway::detail {

/// Takes the distances from one more ball into the field.
template <class Real>
void take_ball(const SourceParts::Ball& ball, const DistanceField<Real>& alone, double radius,
               bool labels, DistanceField<Real>& field) {
  constexpr Real unreached = std::numeric_limits<Real>::infinity();
  if (field.distance.empty()) {
    field.distance.assign(alone.distance.size(), unreached);
    field.label.assign(labels ? alone.distance.size() : 0, none);
    field.error.assign(alone.error.size(), 0);
    field.accuracy = alone.accuracy;
    field.statistics = {};
    field.complete = true;
  }
  if (alone.statistics.windows_gave_up > 0) {
    field.accuracy = alone.accuracy;
    field.error.clear();
  }
  const Real rim = static_cast<Real>(ball.radius), offset = static_cast<Real>(ball.offset);
  for (std::size_t v = 0; v < field.distance.size(); ++v) {
    const Real d = std::abs(alone.distance[v] - rim) + offset;
    if (!(d < field.distance[v]) || d > static_cast<Real>(radius)) continue;
    field.distance[v] = d;
    if (labels) field.label[v] = ball.owner;
    if (!field.error.empty()) field.error[v] = alone.error[v];
  }
  field.statistics.windows_gave_up += alone.statistics.windows_gave_up;
  field.statistics.expansions += alone.statistics.expansions;
  field.statistics.updates += alone.statistics.updates;
  field.statistics.supersteps += alone.statistics.supersteps;
  field.statistics.messages += alone.statistics.messages;
  field.statistics.message_bytes += alone.statistics.message_bytes;
  field.statistics.sent_bytes += alone.statistics.sent_bytes;
  field.statistics.reached_simplices =
      std::max(field.statistics.reached_simplices, alone.statistics.reached_simplices);
  field.complete = field.complete && alone.complete;
}

/// From sources of any kind. Where a domain has them, curves and simplices are what its
/// solve_shapes takes, and the points with them.
template <class E, class D>
void run_parts(const E& executor, const D& domain, std::span<const Source> sources,
               const PropagateOptions& options, WorkspaceOf<E, D>& workspace,
               DistanceField<RealOf<D>>& field) {
  using Real = RealOf<D>;
  SourceParts parts = take_apart(sources, D::kind == DomainKind::wireframe);
  const bool labels = sources.size() > 1;
  field.distance.clear();
  if (!parts.shapes.empty()) {
    if constexpr (requires {
                    solve_shapes(executor, domain, sources, parts, options, workspace, field);
                  })
      solve_shapes(executor, domain, sources, parts, options, workspace, field);
  } else if (!parts.points.empty()) {
    solve_points(executor, domain, std::span<const PointSource>(parts.points), options, workspace,
                 field);
  }
  if (!labels) field.label.clear();
  if (labels && !field.distance.empty()) {
    field.label.resize(field.distance.size());
    for (std::size_t v = 0; v < field.distance.size(); ++v) {
      const bool reached = field.distance[v] < std::numeric_limits<Real>::infinity();
      // From a single point there are no labels.
      const Index part = parts.owner.size() > 1 ? field.label[v] : 0;
      field.label[v] = reached ? parts.owner[part] : none;
    }
  }
  DistanceField<Real> alone;
  for (const SourceParts::Ball& ball : parts.balls) {
    PropagateOptions bounded = options;
    bounded.radius = std::max(options.radius - ball.offset + ball.radius, 0.);
    alone.error.clear();
    alone.accuracy = Accuracy::fast();
    solve_points(executor, domain, std::span<const PointSource>(&ball.centre, 1), bounded,
                 workspace, alone);
    take_ball(ball, alone, options.radius, labels, field);
  }
}

}  // namespace plexway::detail

namespace plexway {

template <ExecutorType E, DomainType D>
requires ExecutorSolves<E, D>
void solve(const E& executor, const D& domain, const SourceList& sources,
           const PropagateOptions& options, WorkspaceOf<E, D>& workspace,
           DistanceField<RealOf<D>>& field) {
  detail::require_support(combination<E, D>(), domain.metric(), sources, options);
  if constexpr (E::kind == ExecutorKind::openmp)
    if (executor.ranks != nullptr)
      detail::check_same_work(*executor.ranks, domain, sources, options, executor.piece,
                              workspace.state().pieces);
  field.error.clear();
  field.accuracy = Accuracy::fast();
  if (sources.only_points()) {
    solve_points(executor, domain, sources.points(), options, workspace, field);
    return;
  }
  detail::run_parts(executor, domain, sources.sources(), options, workspace, field);
}

}  // namespace plexway

namespace plexway::detail {

/// One source after the other.
template <class E, class D>
bool run_rows(const E& executor, const D& domain, const SourceList& sources,
              const PropagateOptions& options, WorkspaceOf<E, D>& workspace,
              std::span<RealOf<D>> distance) {
  check_rows(distance.size(), sources.size(), domain.vertex_count());
  DistanceField<RealOf<D>> field;
  bool complete = true;
  for (std::size_t k = 0; k < sources.size(); ++k) {
    solve(executor, domain, sources.only(k), options, workspace, field);
    std::copy(field.distance.begin(), field.distance.end(),
              distance.begin() + static_cast<std::ptrdiff_t>(k * domain.vertex_count()));
    complete = complete && field.complete;
  }
  return complete;
}

/// One thread a source.
template <class D>
bool run_rows_at_once(const OpenMP& executor, const D& domain, const SourceList& sources,
                      const PropagateOptions& options, WorkspaceOf<OpenMP, D>& workspace,
                      std::span<RealOf<D>> distance) {
  struct Own {  // of a thread
    WorkspaceOf<OpenMP, D> workspace;
    DistanceField<RealOf<D>> field;
    PropagateOptions options;
  };
  const std::size_t vertices = domain.vertex_count();
  check_rows(distance.size(), sources.size(), vertices);
  std::atomic<bool> complete{true};
  share_out_solves<Own>(executor, sources.size(), options,
                        [&](std::size_t k, Own& own, std::size_t thread) {
                          solve(Serial{}, domain, sources.only(k), own.options,
                                thread == 0 ? workspace : own.workspace, own.field);
                          std::copy(own.field.distance.begin(), own.field.distance.end(),
                                    distance.begin() + static_cast<std::ptrdiff_t>(k * vertices));
                          if (!own.field.complete) complete = false;
                        });
  return complete;
}

}  // namespace plexway::detail

namespace plexway {

template <ExecutorType E, DomainType D>
requires ExecutorSolves<E, D>
bool solve_each(const E& executor, const D& domain, const SourceList& sources,
                const PropagateOptions& options, WorkspaceOf<E, D>& workspace,
                std::span<RealOf<D>> distance) {
  if constexpr (E::kind == ExecutorKind::openmp) {
    return detail::run_rows_at_once(executor, domain, sources, options, workspace, distance);
  } else if constexpr (requires {
                         each_point(executor, domain, sources.points(), options, workspace,
                                    distance);
                       }) {
    if (sources.only_points()) {
      detail::require_support(combination<E, D>(), domain.metric(), sources, options);
      detail::check_rows(distance.size(), sources.size(), domain.vertex_count());
      return each_point(executor, domain, sources.points(), options, workspace, distance);
    }
    return detail::run_rows(executor, domain, sources, options, workspace, distance);
  } else {
    return detail::run_rows(executor, domain, sources, options, workspace, distance);
  }
}

}  // namespace plexway

/// Compiles one verb, or both, for an executor and a domain; in namespace plexway.
#define PLEXWAY_SOLVE_OF(E, ...)                                                                \
  template void solve(const E&, const __VA_ARGS__&, const SourceList&, const PropagateOptions&, \
                      WorkspaceOf<E, __VA_ARGS__>&, DistanceField<RealOf<__VA_ARGS__>>&);
#define PLEXWAY_EACH_OF(E, ...)                                                   \
  template bool solve_each(const E&, const __VA_ARGS__&, const SourceList&,       \
                           const PropagateOptions&, WorkspaceOf<E, __VA_ARGS__>&, \
                           std::span<RealOf<__VA_ARGS__>>);
#define PLEXWAY_COMPILE(E, ...)    \
  PLEXWAY_SOLVE_OF(E, __VA_ARGS__) \
  PLEXWAY_EACH_OF(E, __VA_ARGS__)
/// By Serial and by OpenMP.
#define PLEXWAY_COMPILE_HERE(...)      \
  PLEXWAY_COMPILE(Serial, __VA_ARGS__) \
  PLEXWAY_COMPILE(OpenMP, __VA_ARGS__)
/// Both are compiled in another file.
#define PLEXWAY_ELSEWHERE(E, ...) \
  extern PLEXWAY_SOLVE_OF(E, __VA_ARGS__) extern PLEXWAY_EACH_OF(E, __VA_ARGS__)
