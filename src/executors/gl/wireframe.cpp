#include <algorithm>
#include <bit>
#include <limits>

#include <plexway/executors/gl.hpp>

#include "executors/checks.hpp"
#include "executors/gl/run.hpp"

namespace plexway {
namespace {

using namespace gl;
using Implementation = GLWorkspace::Implementation;

struct WireBuffers final : Implementation::DomainBuffers {
  Buffer rows{"rows of edges"}, arcs{"edges"}, inside{"vertex numbers"};

  void release(const Session& session) override {
    for (Buffer* b : {&rows, &arcs, &inside}) b->release(session);
  }
  [[nodiscard]] std::size_t bytes() const override {
    return rows.bytes() + arcs.bytes() + inside.bytes();
  }
};

/// What propagations start from.
struct WireSeeds {
  std::vector<Waiting> waiting;
  std::vector<GLuint> sources;

  void add(const Wireframe<float>& wireframe, std::span<const PointSource> from,
           std::size_t field) {
    const std::size_t first = field * wireframe.vertex_count();
    const auto put = [&](Index v, double sigma, std::size_t number) {
      waiting.push_back(
          {static_cast<GLuint>(first + v), std::bit_cast<GLuint>(static_cast<float>(sigma))});
      sources.push_back(static_cast<GLuint>(number));
    };
    for (std::size_t n = 0; n < from.size(); ++n) {
      const double sigma = from[n].offset / wireframe.unit();
      if (from[n].vertex != none) {
        put(wireframe.inside_vertex(from[n].vertex), sigma, n);
        continue;
      }
      const auto edge = wireframe.inside_edge(from[n].simplex);
      const std::array<double, 4>& b = from[n].barycentric;
      const double length = static_cast<double>(edge.length);
      if (b[1] != 1) put(edge.from, sigma + b[1] * length, n);
      if (b[0] != 1) put(edge.to, sigma + b[0] * length, n);
    }
  }
};

// Several fields over one wireframe, in one launch.
class WireRun {
 public:
  WireRun(const GL& executor, const Wireframe<float>& wireframe, const PropagateOptions& options,
          Implementation& workspace, const Session& session)
      : executor_(executor),
        wireframe_(wireframe),
        options_(options),
        workspace_(workspace),
        session_(session),
        buffers_(workspace.domain_buffers<WireBuffers>(
            session, wireframe.identity(), [&](WireBuffers& fresh) { upload(fresh); })) {}

  bool run(const WireSeeds& seeds, std::size_t fields) {
    fields_ = fields;
    Front& front = workspace_.front;
    const std::size_t cells = fields * wireframe_.vertex_count();
    const double step = options_.schedule == Schedule::fifo
                            ? std::numeric_limits<double>::infinity()
                            : options_.step * wireframe_.typical_edge();
    front.start(session_, cells, sizeof(GLuint), room_for(executor_, cells), step,
                budget_of(options_, fields));
    front.seed<GLuint>(session_, seeds.waiting, seeds.sources);
    const Uniforms program(session_, session_.program("wire_round.comp"));
    program.set("vertex_count", wireframe_.vertex_count());
    program.set("radius", static_cast<float>(options_.radius / wireframe_.unit()));
    buffers_.rows.bind(session_, 5);
    buffers_.arcs.bind(session_, 6);
    const bool complete =
        front.spread(session_, session_.program("wire_round.comp"), session_.context().group(),
                     "#define PLEXWAY_WIRES\n", reporter(options_, cells, wireframe_.unit()));
    workspace_.rounds = front.state().rounds;
    return complete;
  }

  void read_out(std::span<float> distance, std::span<Index> label) {
    finish(session_, workspace_,
           {buffers_.inside, workspace_.front.best(), workspace_.front.labels(),
            wireframe_.vertex_count(), fields_, wireframe_.unit(), options_.radius},
           distance, label);
  }

 private:
  void upload(WireBuffers& to) {
    to.rows.reserve(session_, wireframe_.begin().size_bytes());
    to.rows.write(session_, wireframe_.begin());
    to.arcs.reserve(session_, wireframe_.arcs().size_bytes());
    to.arcs.write(session_, wireframe_.arcs());
    to.inside.reserve(session_, wireframe_.vertices_inside().size_bytes());
    to.inside.write(session_, wireframe_.vertices_inside());
  }

  const GL& executor_;
  const Wireframe<float>& wireframe_;
  const PropagateOptions& options_;
  Implementation& workspace_;
  const Session& session_;
  WireBuffers& buffers_;
  std::size_t fields_ = 1;
};

}  // namespace

void propagate(GL executor, const Wireframe<float>& wireframe, std::span<const PointSource> sources,
               const PropagateOptions& options, GLWorkspace& workspace,
               DistanceField<float>& field) {
  check(sources, options, {wireframe.vertex_count(), wireframe.edge_count(), "edge", 2});
  check_options(options, sources.size());
  Implementation& there = workspace.implementation();
  there.use(Context::of(executor.device));
  WireSeeds seeds;
  seeds.add(wireframe, sources, 0);
  const Session session(*there.context);
  WireRun run(executor, wireframe, options, there, session);
  field.complete = run.run(seeds, 1);
  field.distance.resize(wireframe.vertex_count());
  field.label.resize(sources.size() > 1 ? wireframe.vertex_count() : 0);
  run.read_out(field.distance, field.label);
  set_offsets(sources, options, field.distance);
  const FrontControl& state = there.front.state();
  field.statistics = {FrontControl::wide(state.expansions), FrontControl::wide(state.updates),
                      state.reached};
}

bool propagate_each(GL executor, const Wireframe<float>& wireframe,
                    std::span<const PointSource> sources, const PropagateOptions& options,
                    GLWorkspace& workspace, std::span<float> distance) {
  const std::size_t vertices = wireframe.vertex_count();
  check(sources, options, {vertices, wireframe.edge_count(), "edge", 2});
  check_options(options, sources.size());
  check_size(distance, sources.size(), vertices);
  Implementation& there = workspace.implementation();
  there.use(Context::of(executor.device));
  const Session session(*there.context);
  WireRun run(executor, wireframe, options, there, session);
  const std::size_t most =
      fields_at_once(session, executor, sources.size(), vertices, sizeof(GLuint), vertices);
  bool complete = true;
  for (std::size_t first = 0; first < sources.size(); first += most) {
    const auto some = sources.subspan(first, std::min(most, sources.size() - first));
    WireSeeds seeds;
    for (std::size_t k = 0; k < some.size(); ++k) seeds.add(wireframe, some.subspan(k, 1), k);
    complete &= run.run(seeds, some.size());
    run.read_out(distance.subspan(first * vertices, some.size() * vertices), {});
  }
  for (std::size_t k = 0; k < sources.size(); ++k)
    set_offsets(sources.subspan(k, 1), options, distance.subspan(k * vertices, vertices));
  return complete;
}

}  // namespace plexway
