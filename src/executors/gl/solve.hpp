#pragma once

#include <algorithm>
#include <cstddef>
#include <span>

#include <plexway/executors/gl.hpp>

#include "executors/gl/run.hpp"
#include "labels/endless.hpp"

/// A solve on the device, for any kind of domain. Its Run says what is particular: `Domain`,
/// `Seeds` (a SeedsOf with `add(domain, sources, field, host workspace)`), `check(domain, sources,
/// options)`, `cells(domain)`, the simplices that have labels, `run(seeds, fields)` and
/// `read_out(seeds, distance, label)`.
namespace plexway::gl {

/// One field: the nearest of all sources.
template <class Run>
void solve_nearest(const GL& executor, const typename Run::Domain& domain,
                   std::span<const PointSource> sources, const PropagateOptions& options,
                   GLWorkspace& workspace, DistanceField<float>& field) {
  Run::check(domain, sources, options);
  GLWorkspace::Implementation& there = workspace.implementation();
  there.use(Context::of(executor.device));
  typename Run::Seeds seeds;
  seeds.add(domain, sources, 0, there.host);
  const Session session(*there.context);
  Run run(domain, {executor, options, there, session});
  field.complete = run.run(seeds, 1);
  check_end(FrontControl::wide(there.front.state().expansions), Run::cells(domain));
  field.distance.resize(domain.vertex_count());
  field.label.resize(sources.size() > 1 ? domain.vertex_count() : 0);
  run.read_out(seeds, field.distance, field.label);
  set_offsets(sources, options, field.distance);
  const FrontControl& state = there.front.state();
  field.statistics = {FrontControl::wide(state.expansions), FrontControl::wide(state.updates),
                      state.reached};
}

/// One field a source, as many in one launch as there is room for. False if one ended early.
template <class Run>
bool solve_each(const GL& executor, const typename Run::Domain& domain,
                std::span<const PointSource> sources, const PropagateOptions& options,
                GLWorkspace& workspace, std::span<float> distance) {
  const std::size_t vertices = domain.vertex_count();
  for (std::size_t k = 0; k < sources.size(); ++k)  // each has a field of its own
    Run::check(domain, sources.subspan(k, 1), options);
  GLWorkspace::Implementation& there = workspace.implementation();
  there.use(Context::of(executor.device));
  const Session session(*there.context);
  Run run(domain, {executor, options, there, session});
  const std::size_t most = fields_at_once(session, executor, sources.size(), Run::cells(domain),
                                          sizeof(typename Run::Seeds::Label), vertices);
  typename Run::Seeds seeds;
  bool complete = true;
  for (std::size_t first = 0; first < sources.size(); first += most) {
    const auto some = sources.subspan(first, std::min(most, sources.size() - first));
    seeds.clear();
    for (std::size_t k = 0; k < some.size(); ++k)
      seeds.add(domain, some.subspan(k, 1), k, there.host);
    complete &= run.run(seeds, some.size());
    check_end(FrontControl::wide(there.front.state().expansions), Run::cells(domain) * some.size());
    run.read_out(seeds, distance.subspan(first * vertices, some.size() * vertices), {});
  }
  for (std::size_t k = 0; k < sources.size(); ++k)
    set_offsets(sources.subspan(k, 1), options, distance.subspan(k * vertices, vertices));
  return complete;
}

}  // namespace plexway::gl
