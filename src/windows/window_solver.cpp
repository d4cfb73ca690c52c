#include "windows/window_solver.hpp"

#include <algorithm>
#include <cmath>

#include "windows/window_memory.hpp"

#include "windows/solve_by.inl"

namespace plexway::detail {

namespace windows {

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

template <class Real>
ExactWindows<Real>& WindowSolver<Real>::exact(const Alone&) {
  if (!exact_) exact_.emplace(Sheet<Real>::whole(mesh_, angles_));
  return *exact_;
}

template <class Real>
MergedWindows<Real>& WindowSolver<Real>::merged(const Alone&) {
  if (!merged_) merged_.emplace(Sheet<Real>::whole(mesh_, angles_));
  return *merged_;
}

template <class Real>
typename WindowSolver<Real>::Pieces& WindowSolver<Real>::pieces(std::size_t size, Deal deal) {
  if (!pieces_ || pieces_->patches.size() != size || pieces_->patches.deal() != deal) {
    pieces_.reset();  // its memory first
    pieces_.reset(new Pieces{WindowPatches<Real>(mesh_, angles_, size, deal), {}, {}});
  }
  return *pieces_;
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
  return sizeof(*this) + angles_.bytes() + (exact_ ? exact_->bytes() : 0) +
         (merged_ ? merged_->bytes() : 0) + (kept_ ? kept_->bytes() : 0) +
         (pieces_ ? pieces_->patches.bytes() + (pieces_->exact ? pieces_->exact->bytes() : 0) +
                        (pieces_->merged ? pieces_->merged->bytes() : 0)
                  : 0);
}

template class WindowSolver<float>;
template class WindowSolver<double>;
template bool WindowSolver<float>::solve_by(const Alone&, const WindowSources&, Accuracy,
                                            const PropagateOptions&, WorkspaceState<float>&,
                                            DistanceField<float>&);
template bool WindowSolver<double>::solve_by(const Alone&, const WindowSources&, Accuracy,
                                             const PropagateOptions&, WorkspaceState<double>&,
                                             DistanceField<double>&);

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

}  // namespace plexway::detail
