#include "propagate/windows/window_solver.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <type_traits>

#include <plexway/error.hpp>

#include "complex/number_range.hpp"
#include "propagate/alone.hpp"
#include "propagate/mend_surface.hpp"
#include "propagate/window_memory.hpp"

namespace plexway {
namespace windows {
namespace {

/// What exact windows may take. Scans and CAD parts need 2 to 80 windows a triangle, raw needles
/// 500, two sheets with the same vertices 900, and all more as the root of their number grows; of
/// these 5 at most wait at a time, of 64 bytes each. Who did not ask for windows by name waits
/// about twenty times as long as usual for them, or a second.
Patience patience(std::size_t triangles, bool by_name, bool kept) {
  constexpr std::size_t most_kept = none - (std::size_t{1} << 20);  // they are numbered
  const auto root = static_cast<std::size_t>(std::sqrt(static_cast<double>(triangles)));
  const auto windows = [&](std::size_t a_triangle, int and_two_to) {
    return a_triangle * triangles + (std::size_t{1} << and_two_to);
  };
  if (!by_name) return {std::min(windows(4096, 18), windows(128, 25)), windows(32, 20)};
  return {kept ? std::min(windows(1024, 25), most_kept) : windows(4096 + 16 * root, 20),
          std::min(windows(128, 22), most_kept / 2)};
}

}  // namespace

template <class Real>
WindowSolver<Real>::WindowSolver(const TriangleMesh<Real>& mesh)
    : mesh_(mesh),
      identity_(mesh.identity()),
      triangles_(mesh.triangles().data()),
      angles_(vertex_angles(mesh)) {}

template <class Real>
bool WindowSolver<Real>::is_for(const TriangleMesh<Real>& mesh) const {
  // A copy elsewhere has the same identity, and what is moved keeps its triangles.
  return &mesh == &mesh_ && mesh.identity() == identity_ && mesh.triangles().data() == triangles_;
}

/// From the numbers and the unit inside to the caller's: nothing beyond the radius, an offset to
/// the last bit.
template <class Real>
template <bool kLabels, class Windows>
void WindowSolver<Real>::read_out(const Windows& windows, std::span<const PointSource> sources,
                                  const PropagateOptions& options, bool mends,
                                  WorkspaceState<Real>& workspace,
                                  DistanceField<Real>& field) const {
  NumberRange<Real>::check_unit(mesh_.unit());
  constexpr Real infinity = std::numeric_limits<Real>::infinity();
  const Real radius = static_cast<Real>(options.radius);
  const auto inside = mesh_.vertices_inside();
  workspace.vertex.resize(inside.size());
  if constexpr (kLabels) workspace.vertex_source.resize(inside.size());
  for (Index v = 0; v < inside.size(); ++v) {
    workspace.vertex[v] = static_cast<Real>(windows.distance(v));
    if constexpr (kLabels) workspace.vertex_source[v] = windows.source(v);
  }
  field.statistics = windows.statistics();
  if (mends) {
    const auto mended = surface::mend<Real, kLabels>(mesh_, sources, workspace, Alone{});
    field.statistics.lowered_vertices = mended.lowered;
    field.statistics.raised_vertices = mended.raised;
  }
  field.distance.resize(inside.size());
  field.label.resize(kLabels ? inside.size() : 0);
  for (std::size_t v = 0; v < inside.size(); ++v) {
    const Real d =
        static_cast<Real>(static_cast<double>(workspace.vertex[inside[v]]) * mesh_.unit());
    const bool in = d <= radius;
    field.distance[v] = in ? d : infinity;
    if constexpr (kLabels)
      field.label[v] = in && d < infinity ? workspace.vertex_source[inside[v]] : none;
  }
  for (std::size_t n = 0; n < sources.size(); ++n)
    if (const Index v = sources[n].vertex; v != none && windows.source(mesh_.inside_vertex(v)) == n)
      if (sources[n].offset <= options.radius)
        field.distance[v] = static_cast<Real>(sources[n].offset);
  field.complete = windows.complete();
  const auto triangles = mesh_.triangles();
  for (std::size_t f = 0; f < mesh_.face_count(); ++f)
    field.statistics.reached_simplices += windows.distance(triangles[f].corner[0]) < infinity;
}

template <class Real>
bool WindowSolver<Real>::solve(std::span<const PointSource> sources, Accuracy accuracy,
                               const PropagateOptions& options, WorkspaceState<Real>& workspace,
                               DistanceField<Real>& field) {
  const bool merge = accuracy.kind() != Accuracy::Kind::exact;
  const auto take = [&](const auto& windows) {
    if (sources.size() > 1)
      read_out<true>(windows, sources, options, merge, workspace, field);
    else
      read_out<false>(windows, sources, options, merge, workspace, field);
  };
  if (merge && !merged_) merged_.emplace(mesh_, angles_);
  const auto keep = [&]() -> KeptWindows<Real>* {
    if (!kept_) return nullptr;
    kept_->start(4 * mesh_.face_count());
    return &*kept_;
  };
  // Merged light has no least distance: where lengths are no metric it may gain on itself.
  const auto is_sound = [&] {
    for (Index v = 0; v < mesh_.vertex_count(); ++v)
      if (merged_->distance(v) < 0) return false;
    return true;
  };
  if (!merge || !merged_->solve(sources, options, merge_limit(accuracy.error()), keep()) ||
      !is_sound()) {
    if (!exact_) exact_.emplace(mesh_, angles_);
    const bool may_give_up = options.accuracy.kind() == Accuracy::Kind::usual;
    const Patience limit = patience(mesh_.face_count(), !may_give_up, kept_.has_value());
    if (!exact_->solve(sources, options, limit, keep())) {
      if (may_give_up) return false;
      throw EndlessError("stopped after " + std::to_string(exact_->statistics().expansions) +
                         " windows on " + std::to_string(mesh_.face_count()) +
                         " triangles: too many to wait for; use the accuracy fast, or look for "
                         "triangles that lie on each other");
    }
    take(*exact_);
    field.error.assign(mesh_.vertex_count(), 0);
    return true;
  }
  take(*merged_);
  const auto inside = mesh_.vertices_inside();
  field.error.resize(inside.size());
  for (std::size_t v = 0; v < inside.size(); ++v)
    field.error[v] = field.distance[v] < std::numeric_limits<Real>::infinity()
                         ? merged_->error(inside[v]) * static_cast<Real>(mesh_.unit())
                         : Real(0);
  return true;
}

template <class Real>
void WindowSolver<Real>::keep_windows(bool keep) {
  if (!keep)
    kept_.reset();
  else if (!kept_)
    kept_.emplace();
}

template <class Real>
std::size_t WindowSolver<Real>::bytes() const {
  return sizeof(*this) + angles_.total.capacity() * sizeof(double) + angles_.kind.capacity() +
         (exact_ ? exact_->bytes() : 0) + (merged_ ? merged_->bytes() : 0) +
         (kept_ ? kept_->bytes() : 0);
}

template class WindowSolver<float>;
template class WindowSolver<double>;

}  // namespace windows

template <class Real>
WindowMemory<Real>::WindowMemory() noexcept = default;
template <class Real>
WindowMemory<Real>::~WindowMemory() = default;
template <class Real>
WindowMemory<Real>::WindowMemory(WindowMemory&&) noexcept = default;
template <class Real>
WindowMemory<Real>& WindowMemory<Real>::operator=(WindowMemory&&) noexcept = default;

template <class Real>
windows::WindowSolver<Real>& WindowMemory<Real>::on(const TriangleMesh<Real>& mesh) {
  if (!solver_ || !solver_->is_for(mesh)) {
    solver_.reset();  // its memory first
    solver_ = std::make_unique<windows::WindowSolver<Real>>(mesh);
  }
  solver_->keep_windows(keeps_);
  return *solver_;
}

template <class Real>
std::size_t WindowMemory<Real>::bytes() const {
  return solver_ ? solver_->bytes() : 0;
}

template class WindowMemory<float>;
template class WindowMemory<double>;

}  // namespace plexway
