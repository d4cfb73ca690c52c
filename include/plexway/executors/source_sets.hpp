#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <span>
#include <type_traits>
#include <vector>

#include <plexway/executors/domain_traits.hpp>
#include <plexway/executors/serial.hpp>
#include <plexway/executors/serial_wireframe.hpp>
#include <plexway/source/source.hpp>

namespace plexway {

namespace detail {

/// What sources come down to.
struct SourceParts {
  std::vector<PointSource> points;
  std::vector<Index> owner;  ///< of each point: a place in the list of sources
  struct Ball {
    PointSource centre;
    double radius, offset;
    Index owner;
  };
  std::vector<Ball> balls;
  std::vector<Index> shapes;  ///< curves and simplices
};

/// Throws UsageError for an empty source, and an offset or radius below 0. `edges_only`: in a
/// wireframe curves and edges are as near as their points.
[[nodiscard]] SourceParts take_apart(std::span<const Source> sources, bool edges_only);
[[noreturn]] void refuse_shapes(bool surface, bool single_precision);

/// Points and shapes on a surface, as one field.
void propagate_shapes(const Serial& executor, const TriangleMesh<double>& mesh,
                      std::span<const Source> sources, SourceParts& parts,
                      const PropagateOptions& options, Workspace<double>& workspace,
                      DistanceField<double>& field);

/// Takes the distances from one more ball into the field.
template <class Real>
void take_ball(const SourceParts::Ball& ball, const DistanceField<Real>& alone, double radius,
               bool labels, DistanceField<Real>& field) {
  constexpr Real infinity = std::numeric_limits<Real>::infinity();
  if (field.distance.empty()) {
    field.distance.assign(alone.distance.size(), infinity);
    field.label.assign(labels ? alone.distance.size() : 0, none);
    field.statistics = {};
    field.complete = true;
  }
  const Real rim = static_cast<Real>(ball.radius), offset = static_cast<Real>(ball.offset);
  for (std::size_t v = 0; v < field.distance.size(); ++v) {
    const Real d = std::abs(alone.distance[v] - rim) + offset;
    if (!(d < field.distance[v]) || d > static_cast<Real>(radius)) continue;
    field.distance[v] = d;
    if (labels) field.label[v] = ball.owner;
  }
  field.statistics.expansions += alone.statistics.expansions;
  field.statistics.updates += alone.statistics.updates;
  field.statistics.reached_simplices =
      std::max(field.statistics.reached_simplices, alone.statistics.reached_simplices);
  field.complete = field.complete && alone.complete;
}

template <class Domain>
constexpr bool is_wireframe = false;
template <class Real>
constexpr bool is_wireframe<Wireframe<Real>> = true;
template <class Domain>
constexpr bool is_surface = false;
template <class Real>
constexpr bool is_surface<TriangleMesh<Real>> = true;

}  // namespace detail

/// The distance of every vertex from the nearest of `sources`, of any kind (source/source.hpp), and
/// which one that is, by its place in the list.
///
/// Points and sets of vertices: any domain, any executor. Balls as well; each takes a solve of its
/// own, since inside and outside are not one field. Curves and simplices: wireframes on any
/// executor; surfaces in double (their virtual sources are far away) by Serial, under
/// Visibility::saddles. UsageError for these elsewhere, and as `propagate` from points.
/// Cost: that of `propagate` from as many points; a second solve allocates what the sources need.
template <class Executor, class Domain, class Space, class Real>
void propagate(const Executor& executor, const Domain& domain, std::span<const Source> sources,
               const PropagateOptions& options, Space& workspace, DistanceField<Real>& field) {
  detail::SourceParts parts = detail::take_apart(sources, detail::is_wireframe<Domain>);
  const bool labels = sources.size() > 1;
  field.distance.clear();
  if (!parts.shapes.empty()) {
    if constexpr (requires {
                    detail::propagate_shapes(executor, domain, sources, parts, options, workspace,
                                             field);
                  })
      detail::propagate_shapes(executor, domain, sources, parts, options, workspace, field);
    else
      detail::refuse_shapes(detail::is_surface<Domain>, std::is_same_v<Real, float>);
  } else if (!parts.points.empty()) {
    propagate(executor, domain, std::span<const PointSource>(parts.points), options, workspace,
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
  for (const detail::SourceParts::Ball& ball : parts.balls) {
    PropagateOptions bounded = options;
    bounded.radius = std::max(options.radius - ball.offset + ball.radius, 0.);
    propagate(executor, domain, std::span<const PointSource>(&ball.centre, 1), bounded, workspace,
              alone);
    detail::take_ball(ball, alone, options.radius, labels, field);
  }
}

/// The same with a workspace of its own: that of one thread, or the executor's.
template <class Executor, class Domain>
[[nodiscard]] DistanceField<RealOf<Domain>> propagate(const Executor& executor,
                                                      const Domain& domain,
                                                      std::span<const Source> sources,
                                                      const PropagateOptions& options = {}) {
  DistanceField<RealOf<Domain>> field;
  if constexpr (requires { typename Executor::Workspace; }) {
    typename Executor::Workspace workspace;
    propagate(executor, domain, sources, options, workspace, field);
  } else {
    WorkspaceOf<Domain> workspace;
    propagate(executor, domain, sources, options, workspace, field);
  }
  return field;
}

/// From a single source.
template <class Executor, class Domain>
[[nodiscard]] DistanceField<RealOf<Domain>> propagate(const Executor& executor,
                                                      const Domain& domain, const Source& source,
                                                      const PropagateOptions& options = {}) {
  return propagate(executor, domain, std::span<const Source>(&source, 1), options);
}

}  // namespace plexway
