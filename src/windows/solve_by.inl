// The solves of WindowSolver, for any scheduler: included where one is compiled.

#include <algorithm>
#include <atomic>
#include <limits>
#include <optional>
#include <string>
#include <type_traits>

#include <plexway/error.hpp>

#include "complexes/common/number_range.hpp"
#include "labels/surface/repair_surface.hpp"
#include "windows/window_solver.hpp"

namespace plexway::detail::windows {

template <class Real>
template <class Scheduler>
auto& WindowSolver<Real>::exact(const Scheduler& scheduler) {
  Pieces& all = pieces(scheduler.piece_size(), scheduler.deal());
  if (!all.exact) all.exact.emplace(mesh_, all.patches);
  return *all.exact;
}

template <class Real>
template <class Scheduler>
auto& WindowSolver<Real>::merged(const Scheduler& scheduler) {
  Pieces& all = pieces(scheduler.piece_size(), scheduler.deal());
  if (!all.merged) all.merged.emplace(mesh_, all.patches);
  return *all.merged;
}

/// Does it solve in the memory that distances are read out from?
template <class Windows>
inline constexpr bool works_in_place = false;
template <class Real>
inline constexpr bool works_in_place<MergedWindows<Real>> = true;

/// From the numbers and the unit inside to the caller's: nothing beyond the radius, an offset to
/// the last bit.
template <class Real>
template <bool kLabels, class Windows, class Scheduler>
void WindowSolver<Real>::read_out(const Windows& windows, const WindowSources& sources,
                                  const PropagateOptions& options, bool repairs,
                                  const Scheduler& scheduler, WorkspaceState<Real>& workspace,
                                  DistanceField<Real>& field) const {
  NumberRange<Real>::check_unit(mesh_.unit());
  constexpr Real unreached = std::numeric_limits<Real>::infinity();
  const Real radius = static_cast<Real>(options.radius);
  const auto inside = mesh_.vertices_inside();
  if constexpr (!works_in_place<Windows>) workspace.vertex.resize(inside.size());
  if constexpr (kLabels) workspace.vertex_source.resize(inside.size());
  std::atomic<std::size_t> reached_vertices{0};
  scheduler.over(inside.size(), [&](std::size_t begin, std::size_t end) {
    std::size_t some = 0;
    for (std::size_t i = begin; i < end; ++i) {
      const Index v = static_cast<Index>(i);
      const auto d = windows.distance(v);
      some += d < unreached;
      if constexpr (!works_in_place<Windows>) workspace.vertex[v] = static_cast<Real>(d);
      if constexpr (kLabels) workspace.vertex_source[v] = windows.source(v);
    }
    reached_vertices += some;
  });
  // Of a small part of the mesh all is known, and the rest is not looked at.
  std::optional<surface::Reached> part;
  if (reached_vertices < inside.size() / 16) {
    part.emplace();
    for (Index v = 0; v < inside.size(); ++v)
      if (windows.distance(v) < unreached) part->vertices.push_back(v);
    part->find_triangles(mesh_);
  }
  field.statistics = windows.statistics();
  if (repairs) {
    const auto repaired = surface::repair<Real, kLabels>(
        mesh_, sources.only_points() ? sources.points : std::span<const PointSource>(), workspace,
        scheduler, part ? &*part : nullptr);
    field.statistics.lowered_vertices = repaired.lowered;
    field.statistics.raised_vertices = repaired.raised;
  }
  field.distance.resize(inside.size());
  field.label.resize(kLabels ? inside.size() : 0);
  scheduler.over(inside.size(), [&](std::size_t begin, std::size_t end) {
    for (std::size_t v = begin; v < end; ++v) {
      const Real d =
          static_cast<Real>(static_cast<double>(workspace.vertex[inside[v]]) * mesh_.unit());
      const bool in = d <= radius;
      field.distance[v] = in ? d : unreached;
      if constexpr (kLabels)
        field.label[v] = in && d < unreached ? workspace.vertex_source[inside[v]] : none;
    }
  });
  for (std::size_t n = 0; n < sources.points.size(); ++n) {
    const PointSource& s = sources.points[n];
    if (s.vertex != none && s.offset <= options.radius &&
        windows.source(mesh_.inside_vertex(s.vertex)) == sources.number(n))
      field.distance[s.vertex] = static_cast<Real>(s.offset);
  }
  field.complete = windows.complete();
  field.statistics.reached_simplices = mesh_.face_count();
  if (reached_vertices == inside.size()) return;
  const auto triangles = mesh_.triangles();
  std::atomic<std::size_t> reached{0};
  scheduler.over(
      part ? part->triangles.size() : mesh_.face_count(), [&](std::size_t begin, std::size_t end) {
        std::size_t some = 0;
        for (std::size_t n = begin; n < end; ++n)
          some += windows.distance(triangles[part ? part->triangles[n] : n].corner[0]) < unreached;
        reached.fetch_add(some, std::memory_order_relaxed);
      });
  field.statistics.reached_simplices = reached.load(std::memory_order_relaxed);
}

template <class Real>
template <class Scheduler>
bool WindowSolver<Real>::solve_by(const Scheduler& scheduler, const WindowSources& sources,
                                  Accuracy accuracy, const PropagateOptions& options,
                                  WorkspaceState<Real>& workspace, DistanceField<Real>& field) {
  constexpr bool alone = std::is_same_v<Scheduler, Alone>;
  if constexpr (!alone)
    if (!sources.only_points())
      return solve_by(Alone{}, sources, accuracy, options, workspace, field);
  const bool merge = accuracy.kind() != Accuracy::Kind::exact;
  const auto solved = [&](auto& windows, const auto& limit) {
    if constexpr (alone) {
      if (kept_) kept_->start(4 * mesh_.face_count());
      KeptWindows<Real>* const kept = kept_ ? &*kept_ : nullptr;
      if constexpr (works_in_place<std::remove_cvref_t<decltype(windows)>>)
        return windows.solve(sources, options, limit, workspace.vertex, kept);
      else
        return windows.solve(sources, options, limit, kept);
    } else {
      return windows.solve(scheduler, sources, options, limit);
    }
  };
  const auto take = [&](const auto& windows) {
    if (sources.labels)
      read_out<true>(windows, sources, options, merge, scheduler, workspace, field);
    else
      read_out<false>(windows, sources, options, merge, scheduler, workspace, field);
  };
  // Merged light has no least distance: where lengths are no metric it may gain on itself.
  const auto is_sound = [&](const auto& windows) {
    std::atomic<bool> sound{true};
    scheduler.over(mesh_.vertex_count(), [&](std::size_t begin, std::size_t end) {
      bool all = true;
      for (std::size_t v = begin; v < end; ++v)
        all &= !(windows.distance(static_cast<Index>(v)) < 0);
      if (!all) sound.store(false, std::memory_order_relaxed);
    });
    return sound.load(std::memory_order_relaxed);
  };
  if (merge) {
    auto& windows = merged(scheduler);
    if (solved(windows, merge_limit(accuracy.error())) && is_sound(windows)) {
      take(windows);
      const auto inside = mesh_.vertices_inside();
      field.error.resize(inside.size());
      scheduler.over(inside.size(), [&](std::size_t begin, std::size_t end) {
        for (std::size_t v = begin; v < end; ++v)
          field.error[v] = field.distance[v] < std::numeric_limits<Real>::infinity()
                               ? windows.error(inside[v]) * static_cast<Real>(mesh_.unit())
                               : Real(0);
      });
      return true;
    }
  }
  auto& windows = exact(scheduler);
  const bool may_give_up = options.accuracy.kind() == Accuracy::Kind::usual;
  if (!solved(windows, patience(mesh_.face_count(), !may_give_up, alone && kept_))) {
    if (may_give_up) return false;
    throw EndlessError("stopped after " + std::to_string(windows.statistics().expansions) +
                       " windows on " + std::to_string(mesh_.face_count()) +
                       " triangles: too many to wait for; use the accuracy fast, or look for "
                       "triangles that lie on each other");
  }
  take(windows);
  field.error.assign(mesh_.vertex_count(), 0);
  return true;
}

}  // namespace plexway::detail::windows
