// The loop: strings::Solver::add (strings/solver.cpp) where strings can go
// (strings/mixed_strings.hpp); else labels/mixed/mixed_pieces.hpp calls that of each piece.

#include <algorithm>
#include <array>
#include <limits>
#include <memory>
#include <span>
#include <utility>
#include <variant>
#include <vector>

#include <plexway/error.hpp>

#include "complexes/mixed/joined_pieces.hpp"
#include "executors/checks.hpp"
#include "executors/run.hpp"
#include "executors/threads/share_strings.hpp"
#include "executors/threads/team.hpp"
#include "labels/mixed/mixed_pieces.hpp"
#include "strings/mixed_strings.hpp"

namespace plexway {
using namespace detail;

// A domain of one piece is solved as what it is.
#define PLEXWAY_ONE_PIECE(...)           \
  PLEXWAY_ELSEWHERE(Serial, __VA_ARGS__) \
  PLEXWAY_ELSEWHERE(OpenMP, __VA_ARGS__)
PLEXWAY_SURFACES(PLEXWAY_ONE_PIECE)
PLEXWAY_SOLIDS(PLEXWAY_ONE_PIECE)
PLEXWAY_WIREFRAMES(PLEXWAY_ONE_PIECE)
#undef PLEXWAY_ONE_PIECE

namespace {

// The piece that a source lies in, and the source in that piece's numbers.
template <class Real>
std::pair<Index, PointSource> find_piece(const MixedComplex<Real>& domain, PointSource source) {
  using Piece = typename MixedComplex<Real>::Piece;
  const bool at_vertex = source.vertex != none;
  const auto first = at_vertex ? &Piece::first_vertex : &Piece::first_simplex;
  Index& number = at_vertex ? source.vertex : source.simplex;
  const Piece& piece = piece_of(domain, number, first);
  number -= piece.*first;
  return {piece.number, source};
}

// Sheets that are one surface go by windows where these go: one label a triangle leaks light from
// room to room.
template <class E, class Real>
void solve_single(const E& executor, const typename MixedComplex<Real>::Complex& complex,
                  std::span<const PointSource> sources, PropagateOptions options,
                  Workspace<Real>& workspace, DistanceField<Real>& field) {
  std::visit(
      [&]<class D>(const D& domain) {
        const auto cell = combination<E, D>(SourceKind::point);
        if (std::is_same_v<Real, double> && options.accuracy == Accuracy::usual() &&
            support_of_windows(with(cell, domain.metric(), options)))
          options.accuracy = Accuracy::exact();
        solve(executor, domain, sources, options, workspace, field);
      },
      complex);
}

// Pieces that have vertices in common: what one of them finds for those is a source of the others.
template <class Real>
class PiecesSolve {
 public:
  PiecesSolve(const MixedComplex<Real>& domain, std::vector<WorkspaceState<Real>>& workspaces,
              const PropagateOptions& options, DistanceField<Real>& field)
      : domain_(domain),
        options_(options),
        field_(field),
        waiting_(domain.pieces().size()),
        repaired_(domain.pieces().size()) {
    workspaces.resize(domain.pieces().size());
    for (const auto& piece : domain.pieces())
      pieces_.push_back(
          std::visit([&](const auto& c) { return make_piece(c, workspaces[piece.number]); },
                     domain.complex(piece)));
    welds_.resize(pieces_.size());
    for (const auto& [v, w] : domain.outer_welds()) {
      welds_[piece_of(domain, v).number].push_back({v, w});
      welds_[piece_of(domain, w).number].push_back({w, v});
    }
    find_points();
    field.distance.assign(domain.vertex_count(), std::numeric_limits<Real>::infinity());
    field.label.assign(domain.vertex_count(), none);
    field.statistics = {};
    field.complete = true;
  }

  void run(std::span<const PointSource> sources) {
    for (std::size_t n = 0; n < sources.size(); ++n) {
      const auto [piece, source] = find_piece(domain_, sources[n]);
      waiting_[piece].push_back({source, static_cast<Index>(n)});
      // To the last bit, and where no simplex has the vertex.
      const Index v = sources[n].vertex;
      const Real offset = static_cast<Real>(sources[n].offset);
      if (v != none && offset < field_.distance[v])
        field_.distance[v] = offset, field_.label[v] = static_cast<Index>(n);
    }
    while (field_.complete) {
      const Index next = nearest();
      if (next == none) break;
      add(next);
      tell(next);
    }
    for (const auto& [raised, lowered] : repaired_) {
      field_.statistics.raised_vertices += raised;
      field_.statistics.lowered_vertices += lowered;
    }
    for (bool again = true; again;) {
      again = false;
      for (const auto& [v, w] : domain_.outer_welds()) again |= take(v, w, 1) || take(w, v, 1);
    }
  }

 private:
  // The middle of each edge that two pieces share: paths go over there, too.
  void find_points() {
    points_.resize(pieces_.size());
    std::vector<std::array<Index, 7>> edges;  // pieces, vertices, hinge, and its vertices
    for (Index n = 0; n < domain_.hinges().size(); ++n) {
      const auto& hinge = domain_.hinges()[n];
      for (Index j = 1; j <= hinge.dimension; ++j)
        for (Index i = 0; i < j; ++i) {
          const auto [v, w] = std::minmax({corner(n, i), corner(n, j)});
          edges.push_back({hinge.piece[0], hinge.piece[1], v, w, n, i, j});
        }
    }
    std::sort(edges.begin(), edges.end());
    const auto same = [](const auto& a, const auto& b) {
      return std::equal(a.begin(), a.begin() + 4, b.begin());
    };
    edges.erase(std::unique(edges.begin(), edges.end(), same), edges.end());
    for (const auto& [one, other, v, w, n, i, j] : edges) {
      const Index place[2] = {static_cast<Index>(points_[one].at.size()),
                              static_cast<Index>(points_[other].at.size())};
      for (const std::size_t side : {0U, 1U}) {
        SharedPoints& own = points_[side == 0 ? one : other];
        own.number.push_back(static_cast<Index>(known_.size()));
        own.partner.push_back({side == 0 ? other : one, place[1 - side]});
        const auto& m = member(n, side);
        PointSource& at = own.at.emplace_back(PointSource{.simplex = m.simplex});
        at.barycentric[m.corner[i]] = at.barycentric[m.corner[j]] = .5;
      }
      known_.emplace_back();
    }
  }
  [[nodiscard]] const auto& member(Index hinge, std::size_t side) const {
    return domain_.hinges()[hinge].member[side];
  }
  // A vertex of a hinge, by its number inside the first piece.
  [[nodiscard]] Index corner(Index hinge, std::size_t i) const {
    const auto& m = member(hinge, 0);
    const auto& complex = domain_.complex(domain_.pieces()[domain_.hinges()[hinge].piece[0]]);
    if (const auto* surface = std::get_if<TriangleMesh<Real>>(&complex))
      return surface->triangles()[m.simplex].corner[m.corner[i]];
    return std::get<TetMesh<Real>>(complex).tets()[m.simplex].corner[m.corner[i]];
  }

  // The piece in which the nearest source waits.
  [[nodiscard]] Index nearest() const {
    Index nearest = none;
    double least = std::numeric_limits<double>::infinity();
    for (Index p = 0; p < pieces_.size(); ++p)
      for (const auto& source : waiting_[p])
        if (nearest == none || source.at.offset < least) nearest = p, least = source.at.offset;
    return nearest;
  }

  void add(Index number) {
    const auto& piece = domain_.pieces()[number];
    const PropagateStatistics before = field_.statistics;
    PropagateOptions options = options_;
    options.max_expansions -= before.expansions;
    if (options_.progress)
      options.progress = [&](const Progress& of_piece) {
        const std::size_t all = domain_.simplex_count();
        return options_.progress({before.expansions + of_piece.expansions,
                                  std::min(before.reached_simplices + of_piece.reached, all), all,
                                  of_piece.distance});
      };
    const auto sources = std::exchange(waiting_[number], {});
    const PropagateStatistics took = pieces_[number]->add(sources, options, field_.complete);
    field_.statistics.expansions += took.expansions;
    field_.statistics.updates += took.updates;
    field_.statistics.reached_simplices += took.reached_simplices;
    repaired_[number] = {took.raised_vertices, took.lowered_vertices};
    pieces_[number]->read_out(
        std::span(field_.distance).subspan(piece.first_vertex, piece.vertices),
        std::span(field_.label).subspan(piece.first_vertex, piece.vertices));
  }

  // What others gain at vertices that they have in common with a piece; by more than rounding, else
  // that would go to and fro for ever.
  void tell(Index number) {
    constexpr Real gain = 1 - 64 * std::numeric_limits<Real>::epsilon();
    for (const auto& [own, other] : welds_[number]) {
      if (field_.distance[own] > static_cast<Real>(options_.radius) || !take(own, other, gain))
        continue;
      const auto& piece = piece_of(domain_, other);
      PointSource source = PointSource::at(other - piece.first_vertex);
      source.offset = static_cast<double>(field_.distance[own]);
      waiting_[piece.number].push_back({source, field_.label[own]});
    }
    const SharedPoints& own = points_[number];
    std::vector<MixedFound> found(own.at.size());
    pieces_[number]->read_out(own.at, found);
    for (std::size_t n = 0; n < found.size(); ++n) {
      MixedFound& known = known_[own.number[n]];
      if (!(found[n].distance < known.distance * static_cast<double>(gain)) ||
          found[n].distance > options_.radius)
        continue;
      known = found[n];
      const auto [piece, other] = own.partner[n];
      PointSource source = points_[piece].at[other];
      source.offset = found[n].distance;
      waiting_[piece].push_back({source, found[n].source, true});
    }
  }
  bool take(Index from, Index to, Real gain) {
    if (!(field_.distance[from] < field_.distance[to] * gain)) return false;
    field_.distance[to] = field_.distance[from];
    field_.label[to] = field_.label[from];
    return true;
  }

  const MixedComplex<Real>& domain_;
  const PropagateOptions& options_;
  DistanceField<Real>& field_;
  std::vector<std::unique_ptr<MixedPiece<Real>>> pieces_;
  std::vector<std::vector<MixedSource>> waiting_;         // by piece
  std::vector<std::array<std::size_t, 2>> repaired_;      // by piece: raised, lowered vertices
  std::vector<std::vector<std::array<Index, 2>>> welds_;  // by piece: of its vertices
  struct SharedPoints {
    std::vector<PointSource> at;                   // inside
    std::vector<Index> number;                     // in known_
    std::vector<std::pair<Index, Index>> partner;  // the other piece, and the point there
  };
  std::vector<SharedPoints> points_;  // by piece
  std::vector<MixedFound> known_;
};

template <class E, class Real>
void solve_joined(E executor, const MixedComplex<Real>& domain,
                  std::span<const PointSource> sources, const PropagateOptions& options,
                  Workspace<Real>& kept, DistanceField<Real>& field) {
  if constexpr (E::kind == ExecutorKind::openmp) executor.ranks = nullptr;
  if (domain.pieces().size() == 1) {
    solve_single<E, Real>(executor, domain.complex(domain.pieces()[0]), sources, options, kept,
                          field);
    return;
  }
  if constexpr (E::kind == ExecutorKind::openmp) const Team team(executor);  // may refuse
  PiecesSolve<Real>(domain, kept.state().parts, options, field).run(sources);
  for (std::size_t v = 0; v < field.distance.size(); ++v) {
    if (field.distance[v] <= static_cast<Real>(options.radius)) continue;
    field.distance[v] = std::numeric_limits<Real>::infinity();
    field.label[v] = none;
  }
}

}  // namespace

template <class E, class Real>
void solve_points(const E& executor, const MixedComplex<Real>& domain,
                  std::span<const PointSource> sources, const PropagateOptions& options,
                  Workspace<Real>& kept, DistanceField<Real>& field) {
  check(sources, options);
  for (const PointSource& source : sources) check_source(source, source_domain(domain, source));
  if (auto space = MixedSpace::of(domain); space->media) {
    auto& strings = kept.state().media;
    if (!strings) strings = std::make_shared<MixedStrings>();
    share_strings(executor, domain.vertex_count(), [&](const strings::Threads& threads) {
      strings->solve(domain, std::move(space), sources, options, threads, field);
    });
    return;
  }
  const auto joined = domain.joined();
  if (joined) {
    std::vector<PointSource> own(sources.begin(), sources.end());
    for (PointSource& source : own)
      if (source.vertex != none)
        source.vertex = joined->vertex[source.vertex];
      else
        source.simplex = joined->simplex[source.simplex];
    DistanceField<Real> all;
    solve_joined(executor, joined->domain, std::span<const PointSource>(own), options, kept, all);
    field.complete = all.complete;
    field.statistics = all.statistics;
    field.accuracy = all.accuracy;
    field.distance.resize(domain.vertex_count());
    field.label.resize(all.label.empty() ? 0 : domain.vertex_count());
    field.error.resize(all.error.empty() ? 0 : domain.vertex_count());
    for (std::size_t v = 0; v < field.distance.size(); ++v) {
      field.distance[v] = all.distance[joined->vertex[v]];
      if (!all.label.empty()) field.label[v] = all.label[joined->vertex[v]];
      if (!all.error.empty()) field.error[v] = all.error[joined->vertex[v]];
    }
  } else {
    solve_joined(executor, domain, sources, options, kept, field);
  }
  if (sources.size() == 1) field.label.clear();
}

PLEXWAY_MIXED(PLEXWAY_COMPILE_HERE)

}  // namespace plexway
