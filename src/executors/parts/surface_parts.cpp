#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include <plexway/error.hpp>
#include <plexway/executors/surface_parts.hpp>
#include <plexway/support.hpp>

#include "complexes/common/number_range.hpp"
#include "executors/checks.hpp"
#include "executors/parts/deal_faces.hpp"
#include "executors/parts/part_distances.hpp"
#include "executors/parts/part_pieces.hpp"
#include "executors/parts/part_sources.hpp"
#include "executors/parts/parted_labels.hpp"
#include "executors/parts/parted_windows.hpp"
#include "executors/same_work.hpp"
#include "executors/threads/window_scheduler.hpp"
#include "labels/finish.hpp"
#include "windows/exact_windows.hpp"
#include "windows/merged_windows.hpp"

namespace plexway {
using namespace detail;
namespace {

/// The vertices that a process has, by the surface's numbers, ascending.
template <class Real>
std::vector<Index> part_vertices(const PartPieces<Real>& pieces) {
  std::vector<Index> all(pieces.unreferenced().begin(), pieces.unreferenced().end());
  for (const PartPiece<Real>& part : pieces.parts())
    all.insert(all.end(), part.vertices.begin(), part.vertices.end());
  std::sort(all.begin(), all.end());
  all.erase(std::unique(all.begin(), all.end()), all.end());
  return all;
}

/// What comes out of a solve, made into a field.
template <class Real>
class PartSolve {
 public:
  PartSolve(const Team& team, const PartPieces<Real>& pieces, std::size_t piece_size,
            std::span<const PointSource> sources, const PropagateOptions& options)
      : team_(team),
        pieces_(pieces),
        sources_(part_sources(team.ranks(), pieces, sources)),
        options_(options),
        scheduler_({team, workspace_, 0, pieces.unit(), options}, piece_size) {
    workspace_.pieces.counts().start();
  }

  /// By windows of one kind. False if they became too many, or do not go together with the surface.
  template <class Windows>
  bool by(PartedWindows<Real, Windows>& windows, const typename Windows::Limit& limit) {
    bool solved = false;
    team_.hold([&] { solved = windows.solve(scheduler_, sources_, options_, limit); });
    expansions_ = windows.statistics().expansions;
    if (!solved) return false;
    constexpr bool merged = std::is_same_v<typename Windows::Limit, windows::MergeLimit>;
    std::vector<PartDistances<typename Windows::Number>> known;
    for (std::size_t i = 0; i < pieces_.parts().size(); ++i) known.push_back(windows.known(i));
    agree<Real, typename Windows::Number>(team_.ranks(), pieces_, known, sent());
    for (auto& one : known) take(std::move(one));
    field_.statistics = windows.statistics();
    field_.complete = windows.complete();
    count_reached_triangles();
    if (merged) repair();
    return true;
  }

  /// By labels.
  void by_labels(PartLabelRooms<Real>& rooms) {
    if (options_.visibility == Visibility::saddles)
      by_rule(rooms, SaddlesInParts<Real>{options_.vectorised});
    else
      by_rule(rooms, PlainInParts<Real>{{options_.visibility, options_.probe}});
  }

  [[nodiscard]] std::size_t expansions() const { return expansions_; }

  /// `gave_up`: windows did, before labels.
  PartField<Real> field(const Accuracy& accuracy, bool gave_up = false) {
    field_.accuracy = accuracy;
    finish();
    if (accuracy.kind() == Accuracy::Kind::fast) field_.error.clear();
    field_.statistics.windows_gave_up = gave_up;
    workspace_.pieces.counts().tell(field_.statistics);
    return std::move(field_);
  }

 private:
  static constexpr Real infinity = std::numeric_limits<Real>::infinity();

  [[nodiscard]] std::size_t& sent() { return workspace_.pieces.counts().sent; }

  template <class Like>
  void by_rule(PartLabelRooms<Real>& rooms, const Like& like) {
    with_labels(sources_.all, [&](auto labels) {
      PartedLabels<Real, Like, decltype(labels)::value> solve(team_, pieces_, rooms, like, sources_,
                                                              options_, workspace_.pieces.counts());
      team_.hold([&] { field_.complete = solve.run(); });
      field_.statistics = solve.statistics();
      known_ = solve.read_out();
      agree<Real, Real>(team_.ranks(), pieces_, known_, sent());
      if (options_.visibility == Visibility::saddles) repair();
      solve.read_out_rest(known_);
      agree<Real, Real>(team_.ranks(), pieces_, known_, sent());
    });
  }

  template <class Number>
  void take(PartDistances<Number> known) {
    if constexpr (std::is_same_v<Number, Real>) {
      known_.push_back(std::move(known));
    } else {
      PartDistances<Real>& own = known_.emplace_back();
      own.distance.assign(known.distance.begin(), known.distance.end());
      own.error.assign(known.error.begin(), known.error.end());
      own.source = std::move(known.source);
    }
  }

  void count_reached_triangles() {
    std::size_t reached = 0;
    for (std::size_t i = 0; i < known_.size(); ++i) {
      const PartPiece<Real>& part = pieces_.parts()[i];
      for (std::size_t f = 0; f < part.own; ++f)
        reached += known_[i].distance[part.mesh->triangles()[f].corner[0]] < infinity;
    }
    field_.statistics.reached_simplices = sum_of(team_.ranks(), reached);
  }

  void repair() {
    const auto repaired =
        sources_.all.size() > 1
            ? PartRepair<Real, true>(team_, pieces_, sources_, known_).run(sent())
            : PartRepair<Real, false>(team_, pieces_, sources_, known_).run(sent());
    field_.statistics.lowered_vertices = repaired.lowered;
    field_.statistics.raised_vertices = repaired.raised;
  }

  /// To the caller's unit, and together.
  void finish() {
    NumberRange<Real>::check_unit(pieces_.unit());
    const bool labels = sources_.all.size() > 1;
    const std::vector<Index> vertices = part_vertices(pieces_);
    field_.distance.assign(vertices.size(), infinity);
    field_.error.assign(vertices.size(), 0);
    field_.label.assign(labels ? vertices.size() : 0, none);
    const auto place_of = [&](Index vertex) {
      return static_cast<std::size_t>(std::lower_bound(vertices.begin(), vertices.end(), vertex) -
                                      vertices.begin());
    };
    const auto unit = pieces_.unit();
    const auto radius = static_cast<Real>(options_.radius);
    for (std::size_t i = 0; i < known_.size(); ++i) {
      const PartDistances<Real>& known = known_[i];
      const auto& numbers = pieces_.parts()[i].vertices;
      for (std::size_t v = 0; v < numbers.size(); ++v) {
        const auto d = static_cast<Real>(static_cast<double>(known.distance[v]) * unit);
        if (!(d <= radius) || !(d < infinity)) continue;
        const std::size_t at = place_of(numbers[v]);
        field_.distance[at] = d;
        field_.error[at] = known.error[v] * static_cast<Real>(unit);
        if (labels) field_.label[at] = known.source[v];
      }
    }
    // An offset survives scaling exactly; and a vertex of no triangle is reached from itself.
    for (std::size_t n = 0; n < sources_.all.size(); ++n) {
      const PointSource& s = sources_.all[n];
      if (s.vertex == none || s.offset > options_.radius) continue;
      const std::size_t at = place_of(s.vertex);
      if (at == vertices.size() || vertices[at] != s.vertex) continue;
      const auto offset = static_cast<Real>(s.offset);
      const bool alone = std::binary_search(pieces_.unreferenced().begin(),
                                            pieces_.unreferenced().end(), s.vertex);
      if (alone ? offset < field_.distance[at] : !labels || field_.label[at] == n) {
        field_.distance[at] = offset;
        if (labels) field_.label[at] = static_cast<Index>(n);
      }
    }
    sum_up(vertices);
  }

  /// Each vertex once, in its first piece; in sums piece by piece and source by source, whosever
  /// they are.
  void sum_up(std::span<const Index> vertices) {
    const auto distance_of = [&](Index vertex) {
      return static_cast<double>(field_.distance[static_cast<std::size_t>(
          std::lower_bound(vertices.begin(), vertices.end(), vertex) - vertices.begin())]);
    };
    std::vector<std::pair<Index, std::size_t>> at_sources;  // each vertex, and whose it is
    for (std::size_t n = 0; n < sources_.all.size(); ++n)
      if (sources_.all[n].vertex != none) at_sources.push_back({sources_.all[n].vertex, n});
    std::sort(at_sources.begin(), at_sources.end());
    // The first source there, or the end.
    const auto source_at = [&](Index vertex) {
      const auto first =
          std::lower_bound(at_sources.begin(), at_sources.end(), std::pair(vertex, std::size_t{0}));
      return first != at_sources.end() && first->first == vertex ? first : at_sources.end();
    };
    std::uint64_t counts[] = {0, 0};
    double most = -1;
    const auto look = [&](Index vertex) {
      const double d = distance_of(vertex);
      if (!(d < std::numeric_limits<double>::infinity())) return 0.;
      ++counts[0];
      counts[1] += source_at(vertex) == at_sources.end();
      most = std::max(most, d);
      return d;
    };
    // Bits, each of one process: of pieces, and of sources in no triangle.
    const std::size_t pieces = pieces_.cut().pieces.size();
    std::vector<std::uint64_t> sums(pieces + sources_.all.size(), 0);
    for (const PartPiece<Real>& part : pieces_.parts()) {
      double sum = 0;
      for (Index v = 0; v < part.vertices.size(); ++v)
        if (part.is_first(v, pieces_.cut_of(part))) sum += look(part.vertices[v]);
      sums[part.number] = std::bit_cast<std::uint64_t>(sum);
    }
    for (const Index v : pieces_.unreferenced()) {
      const auto source = source_at(v);
      if (source != at_sources.end())
        sums[pieces + source->second] = std::bit_cast<std::uint64_t>(look(v));
    }
    add_up(team_.ranks(), sums);
    add_up(team_.ranks(), counts);
    double sum = 0;
    for (const std::uint64_t bits : sums) sum += std::bit_cast<double>(bits);
    field_.reached = counts[0];
    field_.beside_source = counts[1];
    if (counts[0] == 0) return;
    field_.max_distance = most_of(team_.ranks(), most);
    double farthest = std::numeric_limits<double>::infinity();
    for (std::size_t v = 0; v < vertices.size() && !(farthest < vertices[v]); ++v)
      if (static_cast<double>(field_.distance[v]) == field_.max_distance) farthest = vertices[v];
    field_.farthest = static_cast<Index>(least_of(team_.ranks(), farthest));
    field_.mean_distance = sum / static_cast<double>(counts[0]);
  }

  const Team& team_;
  const PartPieces<Real>& pieces_;
  PartSources sources_;
  const PropagateOptions& options_;
  WorkspaceState<Real> workspace_;
  WindowScheduler<Real> scheduler_;
  std::vector<PartDistances<Real>> known_;
  std::size_t expansions_ = 0;
  PartField<Real> field_;
};

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
