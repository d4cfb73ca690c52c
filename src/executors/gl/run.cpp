#include "executors/gl/run.hpp"

#include <algorithm>
#include <limits>

#include <plexway/error.hpp>

#include "complexes/common/number_range.hpp"
#include "labels/progress_counter.hpp"

namespace plexway::detail::gl {
void check_number(std::size_t sources) {
  if (sources > std::size_t{1} << 27)
    throw UsageError("the gl executor takes at most 2^27 sources");
}

void Job::start(std::size_t cells, std::size_t label_bytes, std::size_t fields, double step) const {
  const std::size_t room = executor.queue > 0
                               ? executor.queue
                               : std::clamp(cells / 8, std::size_t{4096}, std::size_t{1} << 20);
  constexpr std::size_t most = std::numeric_limits<std::size_t>::max();
  const std::size_t budget =
      options.max_expansions < most / fields ? options.max_expansions * fields : most;
  if (options.schedule == Schedule::fifo) step = std::numeric_limits<double>::infinity();
  workspace.front.start(session, cells, label_bytes, room, step,
                        std::min(budget, endless_after(cells) + 1));
}

std::function<void(const FrontControl&)> reporter(const PropagateOptions& options,
                                                  std::size_t simplices, double unit) {
  if (!options.progress) return {};
  return [&options, simplices, unit](const FrontControl& state) {
    if (!options.progress({FrontControl::wide(state.expansions), state.reached, simplices,
                           static_cast<double>(state.limit) * unit}))
      throw Cancelled("cancelled by the progress callback");
  };
}

std::size_t fields_at_once(const Session& session, const GL& executor, std::size_t sources,
                           std::size_t simplices, std::size_t label_bytes, std::size_t vertices) {
  const std::size_t bytes = simplices * (label_bytes + sizeof(Cell)) + vertices * 8;
  const std::size_t by_memory = executor.batch_bytes / bytes;
  const std::size_t by_block =
      session.limits().block / (simplices * std::max(label_bytes, sizeof(Cell)));
  const std::size_t by_number = (none - 1) / std::max(simplices, vertices);
  return std::clamp(std::min({by_memory, by_block, by_number}), std::size_t{1}, sources);
}

void finish(const Job& job, const Finish& what, std::span<float> distance, std::span<Index> label) {
  NumberRange<float>::check_unit(what.unit);
  const Session& session = job.session;
  GLWorkspace::Implementation& workspace = job.workspace;
  const std::size_t total = what.vertices * what.fields;
  workspace.distances.reserve(session, total * sizeof(GLuint));
  if (!label.empty()) workspace.sources.reserve(session, total * sizeof(GLuint));
  const Uniforms program(
      session, session.program("finish.comp", label.empty() ? "" : "#define PLEXWAY_LABELS\n"));
  program.set("vertex_count", what.vertices);
  program.set("total", total);
  program.set("stride", what.stride);
  program.set("unit", static_cast<float>(what.unit));
  program.set("radius", static_cast<float>(job.options.radius));
  what.inside.bind(session, 5);
  what.vertex_best.bind(session, 6);
  workspace.distances.bind(session, 3);
  if (!label.empty()) {
    what.vertex_source.bind(session, 2);
    workspace.sources.bind(session, 4);
  }
  dispatch(session, total);
  workspace.distances.read(session, distance);
  if (!label.empty()) workspace.sources.read(session, label);
}

void start_read_out(const Job& job, std::size_t vertices, std::size_t offers, bool labels) {
  GLWorkspace::Implementation& there = job.workspace;
  there.vertex_best.reserve(job.session, vertices * sizeof(GLuint));
  there.vertex_best.fill(job.session, FrontControl::unreached, vertices);
  there.small.reserve(job.session, 16 + offers * sizeof(VertexOffer));
  if (!labels) return;
  there.vertex_source.reserve(job.session, vertices * sizeof(GLuint));
  there.vertex_source.fill(job.session, none, vertices);
}

void offer_vertices(const Job& job, const std::vector<VertexOffer>& offers, bool who, bool labels) {
  const Uniforms program(job.session, job.session.program("claim.comp"));
  program.set("count", offers.size());
  program.set("who", std::size_t{who});
  job.workspace.small.write(job.session, std::span<const VertexOffer>(offers));
  job.workspace.small.bind(job.session, 3);
  job.workspace.vertex_best.bind(job.session, 6);
  if (labels) job.workspace.vertex_source.bind(job.session, 7);
  dispatch(job.session, offers.size());
}

bool changes(const Job& job, const std::function<void()>& ask) {
  Buffer& small = job.workspace.small;
  small.fill(job.session, 0, 1);
  small.bind(job.session, 4);
  ask();
  GLuint count = 0;
  small.read(job.session, std::span<GLuint>(&count, 1));
  return count != 0;
}

void set_offsets(std::span<const PointSource> sources, const PropagateOptions& options,
                 std::span<float> distance) {
  for (const PointSource& s : sources)
    if (s.vertex != none && s.offset <= options.radius)
      distance[s.vertex] = std::min(distance[s.vertex], static_cast<float>(s.offset));
}

}  // namespace plexway::detail::gl
