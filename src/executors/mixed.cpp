#include <algorithm>
#include <functional>
#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <variant>
#include <vector>

#include <plexway/error.hpp>

#include "complexes/mixed/joined_pieces.hpp"
#include "executors/checks.hpp"
#include "executors/mixed_lines.hpp"
#include "executors/run.hpp"
#include "executors/threads/crowding.hpp"
#include "executors/threads/team.hpp"
#include "labels/mixed/mixed_propagation.hpp"
#include "strings/mixed_strings.hpp"

namespace plexway {

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
std::pair<Index, PointSource> find_piece(const MixedComplex<Real>& domain,
                                         const PointSource& source) {
  const bool at_vertex = source.vertex != none;
  const Index number = at_vertex ? source.vertex : source.simplex;
  for (const auto& piece : domain.pieces()) {
    const Index first = at_vertex ? piece.first_vertex : piece.first_simplex;
    const Index count = at_vertex ? piece.vertices : piece.simplices;
    if (number < first || number - first >= count) continue;
    PointSource own = source;
    (at_vertex ? own.vertex : own.simplex) = number - first;
    return {piece.number, own};
  }
  throw UsageError(std::string("source ") + (at_vertex ? "vertex " : "simplex ") +
                   std::to_string(number) + " is out of range, there are " +
                   std::to_string(at_vertex ? domain.vertex_count() : domain.simplex_count()));
}

template <class Real>
std::size_t corners_of(const typename MixedComplex<Real>::Complex& complex) {
  if (std::holds_alternative<Wireframe<Real>>(complex)) return 2;
  return std::holds_alternative<TriangleMesh<Real>>(complex) ? 3 : 4;
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
            support_of_windows(detail::with(cell, domain.metric(), options)))
          options.accuracy = Accuracy::exact();
        solve(executor, domain, sources, options, workspace, field);
      },
      complex);
}

// Pieces of several dimensions and speeds, by one thread or a team.
class Turns {
 public:
  Turns(const Serial&, std::size_t) {}
  Turns(const OpenMP& executor, std::size_t pieces)
      : team_(executor), watch_(team_->size()), owned_(pieces) {}

  /// While `body` runs its pieces may take their turns at once.
  template <class Body>
  void hold(const Body& body) {
    if (!team_ || team_->size() == 1)
      body(PiecesAtOnce());
    else
      team_->hold([&] {
        body(PiecesAtOnce([&](std::span<const Index> pieces,
                              const std::function<void(Index)>& work) { run(pieces, work); }));
      });
  }

 private:
  void run(std::span<const Index> pieces, const std::function<void(Index)>& work) {
    ++turn_;
    const double since = seconds_on_wall();
    team_->run([&](int i, int threads) {
      watch_->watch(i, [&] {
        owned_->share(
            turn_, i, threads, pieces.size(), [&](std::size_t k) { return pieces[k]; },
            [&](std::size_t k) { work(pieces[k]); });
      });
    });
    watch_->end_turn(seconds_on_wall() - since);
  }

  std::optional<Team> team_;
  std::optional<CrowdWatch> watch_;
  std::optional<OwnedWork> owned_;
  std::size_t turn_ = 0;
};

// On a domain whose pieces are joined.
template <class Real>
void solve_pieces(const MixedComplex<Real>& domain, std::span<const PointSource> sources,
                  const PropagateOptions& options, WorkspaceState<Real>& workspace,
                  const PiecesAtOnce& at_once, DistanceField<Real>& field) {
  workspace.parts.resize(domain.pieces().size());
  MixedPropagation<Real> propagation(domain, workspace.parts, workspace.offered, options, at_once);
  for (std::size_t n = 0; n < sources.size(); ++n) {
    const auto [piece, source] = find_piece(domain, sources[n]);
    propagation.seed(piece, source, static_cast<Index>(n));
  }
  propagation.run();
  propagation.read_out(field);

  for (std::size_t n = 0; n < sources.size(); ++n) {
    const Index v = sources[n].vertex;
    const Real offset = static_cast<Real>(sources[n].offset);
    if (v != none && offset < field.distance[v])
      field.distance[v] = offset, field.label[v] = static_cast<Index>(n);
  }
  propagation.settle(field);
  const Real infinity = std::numeric_limits<Real>::infinity();
  for (std::size_t v = 0; v < field.distance.size(); ++v)
    if (!(static_cast<double>(field.distance[v]) <= options.radius))
      field.distance[v] = infinity, field.label[v] = none;
    else if (!(field.distance[v] < infinity))
      field.label[v] = none;
}

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
  Turns(executor, domain.pieces().size()).hold([&](const PiecesAtOnce& at_once) {
    solve_pieces(domain, sources, options, kept.state(), at_once, field);
  });
}

}  // namespace

template <class E, class Real>
void solve_points(const E& executor, const MixedComplex<Real>& domain,
                  std::span<const PointSource> sources, const PropagateOptions& options,
                  Workspace<Real>& kept, DistanceField<Real>& field) {
  check(sources, options);
  for (const PointSource& source : sources) {
    const auto [number, own] = find_piece(domain, source);
    const auto& piece = domain.pieces()[number];
    check_source(
        own, {piece.vertices, piece.simplices, "simplex", corners_of<Real>(domain.complex(piece))});
  }
  if (auto space = MixedSpace::of(domain); space->media) {
    auto& strings = kept.state().media;
    if (!strings) strings = std::make_shared<MixedStrings>();
    strings->solve(domain, std::move(space), sources, options, field);
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
  // A single piece knows its own lines.
  if ((joined ? joined->domain : domain).pieces().size() > 1)
    field.statistics.raised_vertices +=
        MixedPlaces<Real>(domain).raise(sources, options.radius, field);
  if (sources.size() == 1) field.label.clear();
}

PLEXWAY_MIXED(PLEXWAY_COMPILE_HERE)

}  // namespace plexway
