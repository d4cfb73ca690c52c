#include "executors/gl/run.hpp"

#include <algorithm>
#include <memory>

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

void finish(const Session& session, GLWorkspace::Implementation& workspace, const Finish& what,
            std::span<float> distance, std::span<Index> label) {
  const std::size_t total = what.vertices * what.fields;
  workspace.distances.reserve(session, total * sizeof(GLuint));
  if (!label.empty()) workspace.sources.reserve(session, total * sizeof(GLuint));
  const Uniforms program(session, session.program("finish.comp", label.empty()
                                                                     ? ""
                                                                     : "#define PLEXWAY_LABELS\n"));
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
