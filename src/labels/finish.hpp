#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <span>
#include <type_traits>

#include <plexway/solve/distance_field.hpp>
#include <plexway/solve/options.hpp>
#include <plexway/source/point_source.hpp>

#include "complexes/common/number_range.hpp"
#include "labels/front.hpp"
#include "labels/workspace_state.hpp"

namespace plexway::detail {

/// Calls `solve` with the front that the options ask for.
template <class Real, class Solve>
void with_queue(const PropagateOptions& options, FrontStorage& storage, Solve solve) {
  if (options.schedule == Schedule::priority)
    solve(PriorityQueue<Real>(storage));
  else
    solve(DualQueue<Real>(storage, step_of<Real>(options)));
}

/// Likewise as one type.
template <class Real>
ChosenQueue<Real> queue_for(const PropagateOptions& options, FrontStorage& storage) {
  return {storage, step_of<Real>(options), options.schedule == Schedule::priority};
}

/// Calls `solve` with std::true_type where vertices have labels: from more than one source.
template <class Solve>
void with_labels(std::span<const PointSource> sources, const Solve& solve) {
  if (sources.size() > 1)
    solve(std::true_type{});
  else
    solve(std::false_type{});
}

/// From what was read out, in the numbers and the unit inside, to the caller's: nothing beyond the
/// radius, +inf where unreached, a source's own offset to the last bit. A distance below 0 is one
/// that still waits in a wireframe.
template <class Real, bool kLabels, class Complex, class Front, class Scheduler>
void finish(const Complex& complex, std::span<const PointSource> sources,
            const PropagateOptions& options, const Front& front,
            const WorkspaceState<Real>& workspace, const Scheduler& scheduler,
            DistanceField<Real>& field) {
  NumberRange<Real>::check_unit(complex.unit());
  constexpr Real unreached = std::numeric_limits<Real>::infinity();
  const std::span<const Index> inside = complex.vertices_inside();
  const Real unit = static_cast<Real>(complex.unit()), radius = static_cast<Real>(options.radius);
  field.distance.resize(inside.size());
  field.label.resize(kLabels ? inside.size() : 0);
  scheduler.over(inside.size(), [&](std::size_t begin, std::size_t end) {
    for (std::size_t v = begin; v < end; ++v) {
      const Real d = std::abs(workspace.vertex[inside[v]]) * unit;
      const bool in = d <= radius;
      field.distance[v] = in ? d : unreached;
      if constexpr (kLabels)
        field.label[v] = in && d < unreached ? workspace.vertex_source[inside[v]] : none;
    }
  });
  // An offset survives scaling exactly.
  for (const PointSource& s : sources)
    if (s.vertex != none && s.offset <= options.radius)
      field.distance[s.vertex] = std::min(field.distance[s.vertex], static_cast<Real>(s.offset));
  field.complete = !front.out_of_budget();
  field.statistics = front.statistics();
}

}  // namespace plexway::detail
