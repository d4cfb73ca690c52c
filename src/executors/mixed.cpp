#include <algorithm>
#include <limits>
#include <string>

#include <plexway/error.hpp>

#include "complex/joined_pieces.hpp"
#include "executors/checks.hpp"
#include "executors/run.hpp"
#include "executors/share_out.hpp"
#include "propagate/mixed_propagation.hpp"
#include "propagate/windows/window_solver.hpp"

namespace plexway {
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

// Sheets that are one surface, where windows go: one label a triangle leaks light from room to
// room.
template <class Real>
const TriangleMesh<Real>* one_surface(const MixedComplex<Real>& domain,
                                      const PropagateOptions& options) {
  if (options.accuracy == Accuracy::fast() || domain.pieces().size() != 1) return nullptr;
  const auto* mesh = std::get_if<TriangleMesh<Real>>(&domain.complex(domain.pieces()[0]));
  if (mesh == nullptr) return nullptr;
  const auto cell = combination<Serial, TriangleMesh<Real>>(SourceKind::point);
  return support_of_windows(detail::with(cell, mesh->metric(), options)) ? mesh : nullptr;
}

template <class Real>
bool solve_by_windows(const TriangleMesh<Real>& mesh, std::span<const PointSource> sources,
                      const PropagateOptions& options, MixedWorkspace<Real>& workspace,
                      DistanceField<Real>& field) {
  const Accuracy accuracy = std::is_same_v<Real, double> ? Accuracy::exact() : Accuracy::accurate();
  workspace.pieces.resize(1);
  Workspace<Real>& own = workspace.pieces[0];
  if (!own.windows.on(mesh).solve(sources, accuracy, options, own, field)) return false;
  field.accuracy = accuracy;
  if (field.label.empty())
    for (const Real d : field.distance)
      field.label.push_back(d < std::numeric_limits<Real>::infinity() ? 0 : none);
  return true;
}

// How pieces that wait are worked through: one after the other, or a thread each.
PiecesAtOnce at_once(const Serial&, const PropagateOptions&) { return {}; }
PiecesAtOnce at_once(const OpenMP& team, const PropagateOptions& options) {
  static_cast<void>(team_size(team));  // that there can be one
  // A budget is spent in order.
  if (options.max_expansions < PropagateOptions{}.max_expansions) return {};
  return [team](std::size_t count, const std::function<void(std::size_t, std::size_t)>& work) {
    detail::share_out(team, count, work);
  };
}

// On a domain whose pieces are joined.
template <class Real>
void solve_joined(const PiecesAtOnce& at_once, const MixedComplex<Real>& domain, std::span<const PointSource> sources,
                  const PropagateOptions& options, MixedWorkspace<Real>& workspace,
                  DistanceField<Real>& field) {
  bool gave_up = false;
  if (const auto* mesh = one_surface(domain, options)) {
    if (solve_by_windows(*mesh, sources, options, workspace, field)) return;
    gave_up = true;
  }
  workspace.pieces.resize(domain.pieces().size());
  MixedPropagation<Real> propagation(domain, workspace.pieces, workspace.offered, options);
  for (std::size_t n = 0; n < sources.size(); ++n) {
    const auto [piece, source] = find_piece(domain, sources[n]);
    propagation.seed(piece, source, static_cast<Index>(n));
  }
  propagation.run(at_once);
  propagation.read_out(workspace.distance, workspace.label, field);
  field.statistics.windows_gave_up = gave_up;

  const auto offer = [&](std::size_t v, Real d, Index label) {
    if (!(d < field.distance[v])) return false;
    field.distance[v] = d;
    field.label[v] = label;
    return true;
  };
  for (std::size_t n = 0; n < sources.size(); ++n)
    if (sources[n].vertex != none)
      offer(sources[n].vertex, static_cast<Real>(sources[n].offset), static_cast<Index>(n));
  // Welded vertices are one. A chain of welds may need several rounds.
  const auto weld = [&] {
    bool any = false, again = true;
    while (again) {
      again = false;
      for (const auto& [v, w] : domain.outer_welds())
        again |= offer(v, field.distance[w], field.label[w]) ||
                 offer(w, field.distance[v], field.label[v]);
      any |= again;
    }
    return any;
  };
  weld();
  while (propagation.relax(field) && weld()) {
  }
  const Real infinity = std::numeric_limits<Real>::infinity();
  for (std::size_t v = 0; v < field.distance.size(); ++v)
    if (!(static_cast<double>(field.distance[v]) <= options.radius))
      field.distance[v] = infinity, field.label[v] = none;
    else if (!(field.distance[v] < infinity))
      field.label[v] = none;
}

}  // namespace

template <ExecutorType E, class Real>
void solve_points(const E& executor, const MixedComplex<Real>& domain,
                  std::span<const PointSource> sources, const PropagateOptions& options,
                  MixedWorkspace<Real>& workspace, DistanceField<Real>& field) {
  check(sources, options);
  for (const PointSource& source : sources) {
    const auto [number, own] = find_piece(domain, source);
    const auto& piece = domain.pieces()[number];
    check_source(
        own, {piece.vertices, piece.simplices, "simplex", corners_of<Real>(domain.complex(piece))});
  }
  if (const auto joined = domain.joined()) {
    std::vector<PointSource> own(sources.begin(), sources.end());
    for (PointSource& source : own)
      if (source.vertex != none)
        source.vertex = joined->vertex[source.vertex];
      else
        source.simplex = joined->simplex[source.simplex];
    DistanceField<Real> all;
    solve_joined(at_once(executor, options), joined->domain, std::span<const PointSource>(own), options, workspace, all);
    field.complete = all.complete;
    field.statistics = all.statistics;
    field.accuracy = all.accuracy;
    field.distance.resize(domain.vertex_count());
    field.label.resize(domain.vertex_count());
    field.error.resize(all.error.empty() ? 0 : domain.vertex_count());
    for (std::size_t v = 0; v < field.distance.size(); ++v) {
      field.distance[v] = all.distance[joined->vertex[v]];
      field.label[v] = all.label[joined->vertex[v]];
      if (!all.error.empty()) field.error[v] = all.error[joined->vertex[v]];
    }
  } else {
    solve_joined(at_once(executor, options), domain, sources, options, workspace, field);
  }
  if (sources.size() == 1) field.label.clear();
}

namespace detail {
PLEXWAY_MIXED(PLEXWAY_COMPILE_HERE)
}  // namespace detail

}  // namespace plexway
