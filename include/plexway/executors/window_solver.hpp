#pragma once

#include <cstddef>
#include <memory>
#include <span>
#include <vector>

#include <plexway/complex/triangle_mesh.hpp>
#include <plexway/propagate/accuracy.hpp>
#include <plexway/propagate/distance_field.hpp>
#include <plexway/propagate/options.hpp>
#include <plexway/source/point_source.hpp>

namespace plexway {

/// Distances on a surface by windows, one solve after the other, on one thread. Keeps what depends
/// on the surface alone, and its memory.
template <class Real>
class WindowSolver {
 public:
  /// `mesh` must outlive the solver. Throws UsageError for a surface with refracting edges. Cost:
  /// one arc tangent a corner.
  explicit WindowSolver(const TriangleMesh<Real>& mesh);
  ~WindowSolver();
  /// Moves what it holds; what is left may be assigned to or destroyed, no more.
  WindowSolver(WindowSolver&&) noexcept;
  /// Likewise.
  WindowSolver& operator=(WindowSolver&&) noexcept;

  /// The distance of every vertex from the nearest of `sources`, as `solve` gives it: in the
  /// caller's order and unit, +inf where no path leads or beyond the radius. Of the options count
  /// schedule, radius, max_expansions (of windows) and progress.
  ///
  /// `error` takes, where it is not null, how far off each distance may be, in the domain's unit,
  /// added up from what merging cost on its way: mostly several times too large, now and then too
  /// small, no bound. 0 where unreached or exact.
  ///
  /// Accuracy::exact(): the same bits whatever the schedule. A second solve has the same bits.
  /// Throws UsageError as `solve` does, for an accuracy out of range, and for
  /// Accuracy::fast(), which is no matter of windows; and Cancelled. Cost: exact 1 to 5 us a
  /// vertex, growing with the root of their number; merged 0.2 to 0.5 us. Sources: Mitchell, Mount,
  /// Papadimitriou (SIAM J. Comput. 1987); Chen, Han (SoCG 1990); Xin, Wang (TOG 2009).
  void solve(std::span<const PointSource> sources, Accuracy accuracy,
             const PropagateOptions& options, DistanceField<Real>& field,
             std::vector<Real>* error = nullptr);

  /// Bytes held, without the mesh.
  [[nodiscard]] std::size_t bytes() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

extern template class WindowSolver<float>;
extern template class WindowSolver<double>;

}  // namespace plexway
