#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>

#include <plexway/solve/accuracy.hpp>
#include <plexway/solve/distance_field.hpp>
#include <plexway/solve/options.hpp>
#include <plexway/surface/triangle_mesh.hpp>

#include "labels/alone.hpp"
#include "labels/workspace_state.hpp"
#include "windows/exact_windows.hpp"
#include "windows/kept_windows.hpp"
#include "windows/merged_windows.hpp"
#include "windows/pieced_windows.hpp"
#include "windows/vertex_angles.hpp"
#include "windows/window_sources.hpp"

namespace plexway::detail::windows {
/// Distances on a surface by windows, one solve after the other, by one thread or by a scheduler.
/// Keeps what depends on the surface alone, and its memory.
template <class Real>
class WindowSolver {
 public:
  /// `mesh` must outlive the solver and have no refracting edges.
  explicit WindowSolver(const TriangleMesh<Real>& mesh);
  WindowSolver(const WindowSolver&) = delete;
  WindowSolver& operator=(const WindowSolver&) = delete;

  /// Was it made for this mesh, as it is now?
  [[nodiscard]] bool is_for(const TriangleMesh<Real>& mesh) const;

  /// The distance of every vertex from the nearest of `sources`, as plexway::solve gives it. Of the
  /// options count schedule, radius, max_expansions (of windows) and progress; all must be checked,
  /// and the accuracy be a merged one or exact. Exact: the same bits whatever the schedule. Throws
  /// Cancelled. Where windows become too many, false and no field if options.accuracy is `usual`;
  /// else EndlessError, and not as soon. Sources: Mitchell, Mount, Papadimitriou (SIAM J. Comput.
  /// 1987); Chen, Han (SoCG 1990); Xin, Wang (TOG 2009).
  ///
  /// What was to be merged is read out as labels are: no vertex is left below the straight line in
  /// space, and none farther than a neighbour and the edge between, where triangles without an area
  /// hide it. `workspace` is for that.
  ///
  /// A scheduler that is not Alone works in pieces of about scheduler.piece_size() triangles.
  /// Exact: the same bits. No windows are kept. What is not only from points is solved as a whole,
  /// by one thread.
  template <class Scheduler>
  [[nodiscard]] bool solve_by(const Scheduler& scheduler, const WindowSources& sources,
                              Accuracy accuracy, const PropagateOptions& options,
                              WorkspaceState<Real>& workspace, DistanceField<Real>& field);

  /// Shall solves keep their windows?
  void keep_windows(bool keep);
  /// Those of the last solve, or null.
  [[nodiscard]] const KeptWindows<Real>* kept() const { return kept_ ? &*kept_ : nullptr; }

  /// Bytes held, without the mesh.
  [[nodiscard]] std::size_t bytes() const;

 private:
  struct Pieces {
    WindowPatches<Real> patches;
    std::optional<PiecedWindows<Real, ExactWindows<Real>>> exact;
    std::optional<PiecedWindows<Real, MergedWindows<Real>>> merged;
  };

  template <bool kLabels, class Windows, class Scheduler>
  void read_out(const Windows& windows, const WindowSources& sources,
                const PropagateOptions& options, bool repairs, const Scheduler& scheduler,
                WorkspaceState<Real>& workspace, DistanceField<Real>& field) const;
  [[nodiscard]] ExactWindows<Real>& exact(const Alone&);
  [[nodiscard]] MergedWindows<Real>& merged(const Alone&);
  template <class Scheduler>
  [[nodiscard]] auto& exact(const Scheduler& scheduler);
  template <class Scheduler>
  [[nodiscard]] auto& merged(const Scheduler& scheduler);
  [[nodiscard]] Pieces& pieces(std::size_t size, Deal deal);

  const TriangleMesh<Real>& mesh_;
  std::uint64_t identity_;
  const TriangleRecord<Real>* triangles_;
  VertexAngles angles_;
  std::optional<ExactWindows<Real>> exact_;
  std::optional<MergedWindows<Real>> merged_;
  std::optional<KeptWindows<Real>> kept_;
  std::unique_ptr<Pieces> pieces_;  ///< of the last scheduler
};

extern template class WindowSolver<float>;
extern template class WindowSolver<double>;
extern template bool WindowSolver<float>::solve_by(const Alone&, const WindowSources&, Accuracy,
                                                   const PropagateOptions&, WorkspaceState<float>&,
                                                   DistanceField<float>&);
extern template bool WindowSolver<double>::solve_by(const Alone&, const WindowSources&, Accuracy,
                                                    const PropagateOptions&,
                                                    WorkspaceState<double>&,
                                                    DistanceField<double>&);

}  // namespace plexway::detail::windows
