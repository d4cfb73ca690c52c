#pragma once

#include <algorithm>
#include <cstddef>
#include <span>

#include <plexway/executors/gl.hpp>

#include "executors/checks.hpp"
#include "executors/gl/run.hpp"
#include "executors/run.hpp"
#include "labels/progress_counter.hpp"

/// A solve on the device, for any kind of domain. Its Run, a RunOn, says what is particular:
/// `Seeds` (a SeedsOf with `add(domain, sources, field, host workspace)`), `cells(domain)`, the
/// simplices that have labels, `upload(session, domain, buffers)`, `run(seeds, fields)`, until no
/// label waits in so many fields (false if the budget is spent), and `read_out(seeds, distance,
/// label)`, fields times vertices in the caller's order, where `label` may be empty.
namespace plexway::detail::gl {
/// Several fields over one domain, in one launch.
template <class D, class Buffers>
class RunOn {
 public:
  using Domain = D;

  static void check(const Domain& domain, std::span<const PointSource> sources,
                    const PropagateOptions& options) {
    detail::check(sources, options, domain);
    check_number(sources.size());
  }

 protected:
  template <class Upload>
  RunOn(const Domain& domain, const Job& job, const Upload& upload)
      : job_(job),
        domain_(domain),
        workspace_(job.workspace),
        session_(job.session),
        buffers_(workspace_.template domain_buffers<Buffers>(
            session_, domain.identity(),
            [&](Buffers& fresh) { upload(job.session, domain, fresh); })),
        radius_(static_cast<float>(job.options.radius / domain.unit())) {}

  const Job job_;
  const Domain& domain_;
  GLWorkspace::Implementation& workspace_;
  const Session& session_;
  Buffers& buffers_;
  float radius_;
  std::size_t fields_ = 1;
};

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

}  // namespace plexway::detail::gl

/// solve_points and each_point of GL for a domain, and what run.hpp compiles of them.
#define PLEXWAY_COMPILE_GL(Run)                                                            \
  void solve_points(const GL& executor, const Run::Domain& domain,                         \
                    std::span<const PointSource> sources, const PropagateOptions& options, \
                    GLWorkspace& workspace, DistanceField<float>& field) {                 \
    gl::solve_nearest<Run>(executor, domain, sources, options, workspace, field);          \
  }                                                                                        \
  bool each_point(const GL& executor, const Run::Domain& domain,                           \
                  std::span<const PointSource> sources, const PropagateOptions& options,   \
                  GLWorkspace& workspace, std::span<float> distance) {                     \
    return gl::solve_each<Run>(executor, domain, sources, options, workspace, distance);   \
  }                                                                                        \
  PLEXWAY_COMPILE(GL, Run::Domain)
