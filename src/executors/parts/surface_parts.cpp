#include <plexway/executors/surface_parts.hpp>

#include <algorithm>
#include <optional>
#include <string>
#include <type_traits>

#include <plexway/error.hpp>
#include <plexway/support.hpp>

#include "executors/checks.hpp"
#include "executors/parts/deal_faces.hpp"
#include "executors/parts/part_pieces.hpp"
#include "executors/parts/part_solve.hpp"
#include "executors/parts/part_sources.hpp"
#include "executors/parts/parted_windows.hpp"
#include "executors/same_work.hpp"
#include "executors/supported.hpp"
#include "windows/exact_windows.hpp"
#include "windows/merged_windows.hpp"

namespace plexway {
using namespace detail;
namespace {

/// Triangles a piece: enough that ghosts are few, and not more pieces than every process can list.
std::size_t part_size(const OpenMP& executor, std::size_t faces) {
  constexpr std::size_t usual = 16384, most_pieces = 65536;
  return executor.piece != 0 ? executor.piece : std::max(usual, faces / most_pieces);
}

}  // namespace

template <class Real>
struct SurfaceParts<Real>::State {
  State(const OpenMP& executor_of_all, const SurfaceRows& rows)
      : executor(executor_of_all),
        team(executor),
        pieces(team, rows, part_size(executor, rows.face_count())) {}

  OpenMP executor;
  Team team;
  PartPieces<Real> pieces;
  std::optional<PartedWindows<Real, windows::MergedWindows<Real>>> merged;
  std::optional<PartedWindows<Real, windows::ExactWindows<Real>>> exact;
  std::optional<PartLabelRooms<Real>> labels;
};

template <class Real>
SurfaceParts<Real>::SurfaceParts(const OpenMP& executor, const SurfaceRows& rows)
    : state_(std::make_unique<State>(executor, rows)) {}
template <class Real>
SurfaceParts<Real>::~SurfaceParts() = default;
template <class Real>
SurfaceParts<Real>::SurfaceParts(SurfaceParts&&) noexcept = default;
template <class Real>
SurfaceParts<Real>& SurfaceParts<Real>::operator=(SurfaceParts&&) noexcept = default;

template <class Real>
const SurfacePartsSummary& SurfaceParts<Real>::summary() const {
  return state_->pieces.summary();
}

template <class Real>
PartPoint SurfaceParts<Real>::nearest(const std::array<double, 3>& point) const {
  return nearest_on(state_->team, state_->pieces, point);
}

template <class Real>
PartField<Real> SurfaceParts<Real>::solve(std::span<const PointSource> sources,
                                          const PropagateOptions& options) {
  State& state = *state_;
  const PartPieces<Real>& pieces = state.pieces;
  const std::size_t faces = pieces.summary().faces;
  const Combination cell = with({.executor = ExecutorKind::openmp,
                                 .domain = DomainKind::surface,
                                 .dimension = 2,
                                 .single_precision = std::is_same_v<Real, float>,
                                 .in_parts = true},
                                options);
  support(cell).require();
  if (PieceRanks* const ranks = state.team.ranks())
    check_same_work(*ranks, SourceList(sources), options, state.executor.piece);
  check(sources, options, SourceDomain{pieces.summary().vertices, faces, "face", 3});
  const Accuracy accuracy = resolved(options.accuracy, cell);
  PartSolve<Real> solve(state.team, pieces, faces / pieces.summary().pieces, sources, options);
  const bool by_windows = accuracy.kind() != Accuracy::Kind::fast;
  if (by_windows) {
    if (accuracy.kind() != Accuracy::Kind::exact) {
      if (!state.merged) state.merged.emplace(pieces);
      if (solve.by(*state.merged, windows::merge_limit(accuracy.error())))
        return solve.field(accuracy);
      state.merged.reset();  // its memory first
    }
    // Among needles merging does not pay: then exactly, as on a surface that one process has.
    if (!state.exact) state.exact.emplace(pieces);
    const bool by_name = options.accuracy.kind() != Accuracy::Kind::usual;
    if (solve.by(*state.exact, windows::patience(faces, by_name, false)))
      return solve.field(accuracy);
    if (by_name)
      throw EndlessError("stopped after " + std::to_string(solve.expansions()) + " windows on " +
                         std::to_string(faces) +
                         " triangles: too many to wait for; use the accuracy fast, or look for "
                         "triangles that lie on each other");
    state.exact.reset();
  }
  if (!state.labels) state.labels.emplace(state.team, pieces);
  solve.by_labels(*state.labels);
  return solve.field(Accuracy::fast(), by_windows);
}

template <class Real>
SurfacePart SurfaceParts<Real>::part(const SurfaceRows& rows) const {
  const PartPieces<Real>& pieces = state_->pieces;
  SurfacePart part;
  part.vertex = part_vertices(pieces);
  part.position = VertexHomes(state_->team.ranks(), rows).fetch(part.vertex);
  part.triangle.reserve(pieces.summary().own_faces);
  for (const PartPiece<Real>& piece : pieces.parts())
    for (std::size_t f = 0; f < piece.own; ++f) {
      std::array<Index, 3>& corners = part.triangle.emplace_back();
      for (std::size_t i = 0; i < 3; ++i)
        corners[i] = static_cast<Index>(
            std::lower_bound(part.vertex.begin(), part.vertex.end(),
                             piece.vertices[piece.mesh->triangles()[f].corner[i]]) -
            part.vertex.begin());
    }
  return part;
}

template <class Real>
std::size_t SurfaceParts<Real>::bytes() const {
  return sizeof(*state_) + state_->pieces.bytes() + (state_->merged ? state_->merged->bytes() : 0) +
         (state_->exact ? state_->exact->bytes() : 0) +
         (state_->labels ? state_->labels->bytes() : 0);
}

template class SurfaceParts<float>;
template class SurfaceParts<double>;

}  // namespace plexway
