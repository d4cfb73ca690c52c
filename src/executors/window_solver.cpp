#include <plexway/executors/window_solver.hpp>

#include <algorithm>
#include <limits>
#include <optional>

#include <plexway/error.hpp>

#include "executors/checks.hpp"
#include "propagate/windows/exact_windows.hpp"
#include "propagate/windows/merged_windows.hpp"
#include "propagate/windows/vertex_angles.hpp"

namespace plexway {

template <class Real>
struct WindowSolver<Real>::State {
  explicit State(const TriangleMesh<Real>& m) : mesh(m), angles(windows::vertex_angles(m)) {}

  const TriangleMesh<Real>& mesh;
  windows::VertexAngles angles;
  std::optional<windows::ExactWindows<Real>> exact;
  std::optional<windows::MergedWindows<Real>> merged;

  /// From the numbers and the unit inside to the caller's: nothing beyond the radius, an offset to
  /// the last bit.
  template <class Windows>
  void read_out(const Windows& windows, std::span<const PointSource> sources,
                const PropagateOptions& options, DistanceField<Real>& field) const {
    constexpr Real infinity = std::numeric_limits<Real>::infinity();
    const auto inside = mesh.vertices_inside();
    const bool labels = sources.size() > 1;
    field.distance.resize(inside.size());
    field.label.resize(labels ? inside.size() : 0);
    for (std::size_t v = 0; v < inside.size(); ++v) {
      const double d = static_cast<double>(windows.distance(inside[v])) * mesh.unit();
      const bool in = d <= options.radius;
      field.distance[v] = in ? static_cast<Real>(d) : infinity;
      if (labels) field.label[v] = in && d < infinity ? windows.source(inside[v]) : none;
    }
    for (std::size_t n = 0; n < sources.size(); ++n)
      if (const Index v = sources[n].vertex;
          v != none && windows.source(mesh.inside_vertex(v)) == n)
        if (sources[n].offset <= options.radius)
          field.distance[v] = static_cast<Real>(sources[n].offset);
    field.complete = windows.complete();
    field.statistics = windows.statistics();
    const auto triangles = mesh.triangles();
    for (std::size_t f = 0; f < mesh.face_count(); ++f)
      field.statistics.reached_simplices += windows.distance(triangles[f].corner[0]) < infinity;
  }
};

template <class Real>
WindowSolver<Real>::WindowSolver(const TriangleMesh<Real>& mesh) {
  refuse_refraction(mesh.summary(), "windows");
  state_ = std::make_unique<State>(mesh);
}
template <class Real>
WindowSolver<Real>::~WindowSolver() = default;
template <class Real>
WindowSolver<Real>::WindowSolver(WindowSolver&&) noexcept = default;
template <class Real>
WindowSolver<Real>& WindowSolver<Real>::operator=(WindowSolver&&) noexcept = default;

template <class Real>
void WindowSolver<Real>::solve(std::span<const PointSource> sources, Accuracy accuracy,
                               const PropagateOptions& options, DistanceField<Real>& field,
                               std::vector<Real>* error) {
  const TriangleMesh<Real>& mesh = state_->mesh;
  check(sources, options, {mesh.vertex_count(), mesh.face_count(), "face", 3});
  if (accuracy.kind() == Accuracy::Kind::fast)
    throw UsageError("accuracy fast is one label a triangle: ask propagate for it");
  if (!(accuracy.error() >= 0 && accuracy.error() < 1))
    throw UsageError("the accuracy must be a relative error from 0 to below 1");
  if (error) error->assign(mesh.vertex_count(), 0);
  const bool merge = accuracy.kind() == Accuracy::Kind::merged;
  if (merge && !state_->merged) state_->merged.emplace(mesh, state_->angles);
  if (!merge ||
      !state_->merged->solve(sources, options, windows::merge_limit(accuracy.error()))) {
    if (!state_->exact) state_->exact.emplace(mesh, state_->angles);
    state_->exact->solve(sources, options);
    state_->read_out(*state_->exact, sources, options, field);
    return;
  }
  state_->read_out(*state_->merged, sources, options, field);
  if (!error) return;
  const auto inside = mesh.vertices_inside();
  for (std::size_t v = 0; v < inside.size(); ++v)
    if (field.distance[v] < std::numeric_limits<Real>::infinity())
      (*error)[v] = state_->merged->error(inside[v]) * static_cast<Real>(mesh.unit());
}

template <class Real>
std::size_t WindowSolver<Real>::bytes() const {
  return sizeof(State) + state_->angles.total.capacity() * sizeof(double) +
         state_->angles.kind.capacity() + (state_->exact ? state_->exact->bytes() : 0) +
         (state_->merged ? state_->merged->bytes() : 0);
}

template class WindowSolver<float>;
template class WindowSolver<double>;

}  // namespace plexway
