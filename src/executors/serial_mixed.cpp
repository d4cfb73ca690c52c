#include <plexway/executors/serial_mixed.hpp>

#include <algorithm>
#include <cmath>
#include <string>

#include <plexway/error.hpp>

#include "propagate/mixed_propagation.hpp"

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
void check_point(const MixedComplex<Real>& domain, Index piece, const PointSource& source) {
  if (!(source.offset >= 0) || !std::isfinite(source.offset))
    throw UsageError("a source's offset must be a number >= 0");
  if (source.vertex != none) return;
  const auto& complex = domain.complex(domain.pieces()[piece]);
  const std::size_t corners = std::holds_alternative<Wireframe<Real>>(complex)      ? 2
                              : std::holds_alternative<TriangleMesh<Real>>(complex) ? 3
                                                                                    : 4;
  double sum = 0;
  bool inside = true;
  for (std::size_t i = 0; i < 4; ++i) {
    const double b = source.barycentric[i];
    inside = inside && b >= 0 && (i < corners || b == 0);
    sum += b;
  }
  if (!inside || !(std::abs(sum - 1) < 1e-6))
    throw UsageError("a source's barycentric coordinates must be >= 0 and sum to 1");
}

void check(const PropagateOptions& options) {
  if (!(options.step > 0)) throw UsageError("the step must be > 0");
  if (!(options.radius >= 0)) throw UsageError("the radius must be >= 0");
  if (options.visibility != Visibility::saddles)
    throw UsageError("mixed domains know the default visibility only");
  if (options.schedule == Schedule::priority)
    throw UsageError("mixed domains are not propagated nearest first: use the dual queue");
}

}  // namespace

template <class Real>
void propagate(Serial, const MixedComplex<Real>& domain, std::span<const PointSource> sources,
               const PropagateOptions& options, MixedWorkspace<Real>& workspace,
               DistanceField<Real>& field) {
  if (sources.empty()) throw UsageError("there is no source: name at least one");
  if (sources.size() >= none) throw UsageError("too many sources");
  check(options);
  for (const PointSource& source : sources)
    check_point(domain, find_piece(domain, source).first, source);

  workspace.pieces.resize(domain.pieces().size());
  MixedPropagation<Real> propagation(domain, workspace.pieces, workspace.offered, options);
  for (std::size_t n = 0; n < sources.size(); ++n) {
    const auto [piece, source] = find_piece(domain, sources[n]);
    propagation.seed(piece, source, static_cast<Index>(n));
  }
  propagation.run();
  propagation.read_out(workspace.distance, workspace.label, field);

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
  if (sources.size() == 1) field.label.clear();
}

template <class Real>
DistanceField<Real> propagate(Serial executor, const MixedComplex<Real>& domain,
                              std::span<const PointSource> sources,
                              const PropagateOptions& options) {
  MixedWorkspace<Real> workspace;
  DistanceField<Real> field;
  propagate(executor, domain, sources, options, workspace, field);
  return field;
}

template void propagate(Serial, const MixedComplex<float>&, std::span<const PointSource>,
                        const PropagateOptions&, MixedWorkspace<float>&, DistanceField<float>&);
template void propagate(Serial, const MixedComplex<double>&, std::span<const PointSource>,
                        const PropagateOptions&, MixedWorkspace<double>&, DistanceField<double>&);
template DistanceField<float> propagate(Serial, const MixedComplex<float>&,
                                        std::span<const PointSource>, const PropagateOptions&);
template DistanceField<double> propagate(Serial, const MixedComplex<double>&,
                                         std::span<const PointSource>, const PropagateOptions&);

}  // namespace plexway
