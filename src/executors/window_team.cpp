#include "executors/window_team.hpp"

#include <cmath>
#include <cstddef>

#include "executors/crew.hpp"
#include "executors/piece_size.hpp"
#include "executors/supersteps.hpp"
#include "executors/team.hpp"
#include "propagate/windows/solve_by.inl"

namespace plexway {
namespace {

/// A superstep's, in roots of the number of triangles: mean edges. Half of what labels take:
/// windows that come late do not merge with those that were there.
constexpr double pace = 1. / 32;

template <class Real>
class WindowCrew : public TeamCrew<Real, false> {
 public:
  using Base = TeamCrew<Real, false>;
  WindowCrew(const Base& base, std::size_t size) : Base(base), size_(size) {}

  [[nodiscard]] std::size_t piece_size() const { return size_; }

  template <class Pieces, class GoesOn>
  bool run(Pieces& pieces, std::size_t triangles, const PropagateStatistics& before,
           const GoesOn& goes_on) const {
    using Piece = typename Pieces::value_type;
    Supersteps<Piece> supersteps(this->team_, pieces, pace * std::sqrt(static_cast<double>(size_)),
                                 triangles, this->unit_, this->options_,
                                 this->workspace_.pieces.counts());
    return supersteps.run({.expansions = before.expansions}, goes_on);
  }
  template <class Work>
  void each(std::size_t count, const Work& work) const {
    this->team_.each(count, work);
  }

 private:
  std::size_t size_;
};

}  // namespace

template <class Real>
bool solve_by_windows(const OpenMP& executor, const TriangleMesh<Real>& mesh,
                      std::span<const PointSource> sources, Accuracy accuracy,
                      const PropagateOptions& options, WorkspaceState<Real>& workspace,
                      DistanceField<Real>& field) {
  const Team team(executor);
  auto& solver = workspace.windows.on(mesh);
  const std::size_t size = piece_size(executor, mesh.face_count(), {2048, 128});
  if (is_one_piece(size, mesh.face_count()) || options.schedule != Schedule::dual_queue ||
      solver.kept() != nullptr)
    return solver.solve(sources, accuracy, options, workspace, field);
  workspace.front.reserve(mesh.face_count());
  const TeamCrew<Real, false> crew(team, workspace, 0, mesh.unit(), options);
  bool solved = false;
  team.hold([&] {
    solved =
        solver.solve_by(WindowCrew<Real>(crew, size), sources, accuracy, options, workspace, field);
  });
  return solved;
}

template bool solve_by_windows(const OpenMP&, const TriangleMesh<float>&,
                               std::span<const PointSource>, Accuracy, const PropagateOptions&,
                               WorkspaceState<float>&, DistanceField<float>&);
template bool solve_by_windows(const OpenMP&, const TriangleMesh<double>&,
                               std::span<const PointSource>, Accuracy, const PropagateOptions&,
                               WorkspaceState<double>&, DistanceField<double>&);

}  // namespace plexway
