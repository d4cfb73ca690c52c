#pragma once

#include <cstddef>
#include <memory>

#include <plexway/surface/triangle_mesh.hpp>

namespace plexway::detail::windows {
template <class Real>
class WindowSolver;
}  // namespace plexway::detail::windows

namespace plexway::detail {

/// What solves by windows (Accuracy) keep from call to call: what depends on a surface alone, and
/// memory. Holds nothing before the first.
template <class Real>
class WindowMemory {
 public:
  WindowMemory() noexcept;
  ~WindowMemory();
  WindowMemory(WindowMemory&&) noexcept;
  WindowMemory& operator=(WindowMemory&&) noexcept;

  /// The solver of this surface: the one of the last call, unless that was for another, or for what
  /// was there before. Refers to `mesh`. Cost of a new one: an arc tangent a corner.
  windows::WindowSolver<Real>& on(const TriangleMesh<Real>& mesh);

  /// The solver of the last call, or null.
  [[nodiscard]] const windows::WindowSolver<Real>* solver() const { return solver_.get(); }

  /// Shall solves keep all windows, for distances inside triangles?
  void keep_windows(bool keep) { keeps_ = keep; }

  [[nodiscard]] std::size_t bytes() const;

 private:
  std::unique_ptr<windows::WindowSolver<Real>> solver_;
  bool keeps_ = false;
};

extern template class WindowMemory<float>;
extern template class WindowMemory<double>;

}  // namespace plexway::detail
