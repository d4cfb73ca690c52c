#include <plexway/executors/serial_pairs.hpp>

#include <limits>

#include <plexway/propagate/pair_rule.hpp>
#include <plexway/propagate/wavefront.hpp>

#include "executors/alone.hpp"
#include "executors/checks.hpp"
#include "propagate/finish.hpp"

namespace plexway {
namespace {

template <class Real, bool kLabels>
void solve(const PointPairs<Real>& pairs, std::span<const PointSource> sources,
           const PropagateOptions& options, Workspace<Real>& workspace,
           DistanceField<Real>& field) {
  const std::size_t places = pairs.places().size();
  workspace.start(places, false);
  workspace.front.reserve(places);
  workspace.vertex.assign(places, std::numeric_limits<Real>::infinity());
  if constexpr (kLabels) workspace.vertex_source.assign(places, none);
  const Real radius = static_cast<Real>(options.radius / pairs.unit());
  with_queue<Real>(options, workspace.front, [&](auto queue) {
    Wavefront<Real, PairLabel<Real>, decltype(queue), kLabels> wave(
        workspace.marks, workspace.pairs.reserve(places), queue, workspace.vertex_source.data(),
        places, pairs.unit(), options);
    PairRule<Real, decltype(wave)> rule(
        pairs, workspace.vertex.data(), wave,
        static_cast<Real>(options.visibility == Visibility::upper_bound ? 0 : 1));
    for (std::size_t n = 0; n < sources.size(); ++n)
      rule.seed(pairs.inside_vertex(sources[n].vertex),
                static_cast<Real>(sources[n].offset / pairs.unit()), static_cast<Index>(n));
    Index c = 0;
    const auto distance_of = [&](Index x) { return rule.distance(x); };
    do {
      while (wave.next(c, distance_of))
        if (!(rule.distance(c) > radius)) rule.expand(c);
    } while (wave.take_stock(rule.distance(c)));
    finish<Real, kLabels>(pairs, sources, options, wave, workspace, Alone{}, field);
  });
}

}  // namespace

template <class Real>
void propagate(Serial, const PointPairs<Real>& pairs, std::span<const PointSource> sources,
               const PropagateOptions& options, Workspace<Real>& workspace,
               DistanceField<Real>& field) {
  for (const PointSource& s : sources)
    if (s.vertex == none) throw UsageError("a source of a point cloud must be one of its points");
  check(sources, options, {pairs.point_count(), 0, "simplex", 0});
  if (sources.size() > 1)
    solve<Real, true>(pairs, sources, options, workspace, field);
  else
    solve<Real, false>(pairs, sources, options, workspace, field);
}

template <class Real>
DistanceField<Real> propagate(Serial executor, const PointPairs<Real>& pairs,
                              std::span<const PointSource> sources,
                              const PropagateOptions& options) {
  Workspace<Real> workspace;
  DistanceField<Real> field;
  propagate(executor, pairs, sources, options, workspace, field);
  return field;
}

template void propagate(Serial, const PointPairs<float>&, std::span<const PointSource>,
                        const PropagateOptions&, Workspace<float>&, DistanceField<float>&);
template void propagate(Serial, const PointPairs<double>&, std::span<const PointSource>,
                        const PropagateOptions&, Workspace<double>&, DistanceField<double>&);
template DistanceField<float> propagate(Serial, const PointPairs<float>&,
                                        std::span<const PointSource>, const PropagateOptions&);
template DistanceField<double> propagate(Serial, const PointPairs<double>&,
                                         std::span<const PointSource>, const PropagateOptions&);

}  // namespace plexway
