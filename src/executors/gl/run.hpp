#pragma once

#include <algorithm>
#include <cstddef>
#include <functional>
#include <span>
#include <vector>

#include <plexway/executors/gl.hpp>
#include <plexway/solve/distance_field.hpp>

#include "executors/checks.hpp"
#include "executors/gl/context.hpp"
#include "executors/gl/seeds.hpp"
#include "executors/gl/workspace.hpp"
#include "executors/run.hpp"
#include "labels/progress_counter.hpp"

namespace plexway::detail::gl {

/// Throws UsageError for more sources than the device tells apart.
void check_number(std::size_t sources);

/// What a solve was asked to do, and where.
struct Job {
  const GL& executor;
  const PropagateOptions& options;
  GLWorkspace::Implementation& workspace;
  const Session& session;

  /// All `cells` of so many fields unreached, labels of so many bytes; `step` is the dual queue's,
  /// in the unit inside.
  void start(std::size_t cells, std::size_t label_bytes, std::size_t fields, double step) const;
};

/// Calls the caller's progress function with what the device has done. Throws Cancelled.
std::function<void(const FrontControl&)> reporter(const PropagateOptions& options,
                                                  std::size_t simplices, double unit);

/// The last step of every solve: distances at vertices (bits of the least, in the numbers and the
/// unit inside) in `vertex_best`, and their sources if `labels` is not empty, to the caller's
/// arrays of fields times vertices.
struct Finish {
  const Buffer& inside;       ///< the number inside of each vertex
  const Buffer& vertex_best;  ///< the last of `stride` numbers a vertex
  std::size_t stride;
  const Buffer& vertex_source;
  std::size_t vertices, fields;
  double unit;
};
void finish(const Job& job, const Finish& what, std::span<float> distance, std::span<Index> label);

/// The steps before, where labels are not those of vertices: so many vertices unreached, then what
/// sources offer to them, or, of those that came out so near, whose they are.
void start_read_out(const Job& job, std::size_t vertices, std::size_t offers, bool labels);
void offer_vertices(const Job& job, const std::vector<VertexOffer>& offers, bool who, bool labels);
/// `ask`, a dispatch that counts what it changed at binding 4. True if there is anything.
bool changes(const Job& job, const std::function<void()>& ask);

/// A source's own offset survives scaling exactly.
void set_offsets(std::span<const PointSource> sources, const PropagateOptions& options,
                 std::span<float> distance);

/// Of `sources` fields over so many simplices and vertices, how many one launch should hold.
std::size_t fields_at_once(const Session& session, const GL& executor, std::size_t sources,
                           std::size_t simplices, std::size_t label_bytes, std::size_t vertices);

/// Several fields over one domain, in one launch. A Run, which derives from this, says what is
/// particular to a kind of domain: `Seeds` (a SeedsOf with `add(domain, sources, field, host
/// workspace)`), `cells(domain)`, the simplices that have labels, `upload(session, domain,
/// buffers)`, `run(seeds, fields)`, until no label waits in so many fields (false if the budget is
/// spent), and `read_out(seeds, distance, label)`, fields times vertices in the caller's order,
/// where `label` may be empty.
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

/// solve_points and each_point of GL for a domain, and what executors/run.hpp compiles of them.
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
