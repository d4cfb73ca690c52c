#include "executors/gl/run.hpp"

#include <algorithm>
#include <limits>

#include <plexway/error.hpp>

namespace plexway::gl {

void check_options(const PropagateOptions& options, std::size_t sources) {
  if (options.visibility != Visibility::saddles)
    throw UsageError("the gl executor knows Visibility::saddles only: use another executor");
  if (options.schedule == Schedule::priority)
    throw UsageError(
        "Schedule::priority needs an order among labels, which the gl executor does not keep: use "
        "Serial, or another schedule");
  if (sources >= std::size_t{1} << 30)
    throw UsageError("the gl executor takes at most 2^30 - 1 sources");
}

std::size_t room_for(const GL& executor, std::size_t cells) {
  if (executor.queue > 0) return executor.queue;
  return std::clamp(cells / 8, std::size_t{4096}, std::size_t{1} << 20);
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
  const std::size_t bytes = simplices * (label_bytes + sizeof(GLuint)) + vertices * 8;
  const std::size_t by_memory = executor.batch_bytes / bytes;
  const std::size_t by_block = session.limits().block / (simplices * label_bytes);
  const std::size_t by_number = (none - 1) / std::max(simplices, vertices);
  return std::clamp(std::min({by_memory, by_block, by_number}), std::size_t{1}, sources);
}

std::size_t budget_of(const PropagateOptions& options, std::size_t fields) {
  constexpr std::size_t most = std::numeric_limits<std::size_t>::max();
  return options.max_expansions < most / fields ? options.max_expansions * fields : most;
}

void check_size(std::span<const float> distance, std::size_t sources, std::size_t vertices) {
  if (distance.size() != sources * vertices)
    throw UsageError("room for " + std::to_string(distance.size()) + " distances, but " +
                     std::to_string(sources) + " fields of " + std::to_string(vertices) +
                     " vertices need " + std::to_string(sources * vertices));
}

void finish(const Session& session, GLWorkspace::Implementation& workspace, const Finish& what,
            std::span<float> distance, std::span<Index> label) {
  const std::size_t total = what.vertices * what.fields;
  workspace.distances.reserve(session, total * sizeof(GLuint));
  if (!label.empty()) workspace.sources.reserve(session, total * sizeof(GLuint));
  const Uniforms program(
      session, session.program("finish.comp", label.empty() ? "" : "#define PLEXWAY_LABELS\n"));
  program.set("vertex_count", what.vertices);
  program.set("total", total);
  program.set("unit", static_cast<float>(what.unit));
  program.set("radius", static_cast<float>(what.radius));
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

void set_offsets(std::span<const PointSource> sources, const PropagateOptions& options,
                 std::span<float> distance) {
  for (const PointSource& s : sources)
    if (s.vertex != none && s.offset <= options.radius)
      distance[s.vertex] = std::min(distance[s.vertex], static_cast<float>(s.offset));
}

}  // namespace plexway::gl
