#include <algorithm>
#include <limits>

#include <plexway/executors/gl.hpp>

#include "executors/checks.hpp"
#include "executors/gl/run.hpp"
#include "executors/gl/surface_seeds.hpp"

namespace plexway {
namespace {

using namespace gl;
using Implementation = GLWorkspace::Implementation;

struct SurfaceBuffers final : Implementation::DomainBuffers {
  Buffer triangles{"triangles"}, inside{"vertex numbers"}, pinches{"pinched vertices"},
      corners{"corners at pinched vertices"};

  void release(const Session& session) override {
    for (Buffer* b : {&triangles, &inside, &pinches, &corners}) b->release(session);
  }
  [[nodiscard]] std::size_t bytes() const override {
    return triangles.bytes() + inside.bytes() + pinches.bytes() + corners.bytes();
  }
};

// Several fields over one surface, in one launch.
class SurfaceRun {
 public:
  SurfaceRun(const GL& executor, const TriangleMesh<float>& mesh, const PropagateOptions& options,
             Implementation& workspace, const Session& session)
      : executor_(executor),
        mesh_(mesh),
        options_(options),
        workspace_(workspace),
        session_(session),
        buffers_(workspace.domain_buffers<SurfaceBuffers>(
            session, mesh.identity(), [&](SurfaceBuffers& fresh) { upload(fresh); })),
        radius_(static_cast<float>(options.radius / mesh.unit())) {}

  /// Until no label waits, in so many fields. False if the budget is spent.
  bool run(const SurfaceSeeds& seeds, std::size_t fields) {
    fields_ = fields;
    Front& front = workspace_.front;
    const double step = options_.schedule == Schedule::fifo
                            ? std::numeric_limits<double>::infinity()
                            : options_.step;
    front.start(session_, cells(), sizeof(SurfaceLabel), room_for(executor_, cells()), step,
                budget_of(options_, fields));
    front.seed<SurfaceLabel>(session_, seeds.waiting, seeds.labels);
    const GLuint rule = session_.program("surface_round.comp");
    const auto report = reporter(options_, cells(), mesh_.unit());
    bool complete = true;
    int revivals = 0;
    do {
      set_rule_uniforms(rule, revivals > 8);
      buffers_.triangles.bind(session_, 5);
      const std::size_t share = session_.context().group() / 2;  // two invocations a label
      complete = front.spread(session_, rule, share, "", report);
      ++revivals;
    } while (complete && (pass_pinches() || revive()));
    workspace_.rounds = front.state().rounds;
    return complete;
  }

  /// Fields times vertices, in the caller's order; `label` may be empty.
  void read_out(const SurfaceSeeds& seeds, std::span<float> distance, std::span<Index> label) {
    const std::size_t vertices = fields_ * mesh_.vertex_count();
    workspace_.vertex_best.reserve(session_, vertices * sizeof(GLuint));
    workspace_.vertex_best.fill(session_, FrontControl::unreached, vertices);
    workspace_.small.reserve(session_, 16 + seeds.offers.size() * sizeof(VertexOffer));
    if (!label.empty()) {
      workspace_.vertex_source.reserve(session_, vertices * sizeof(GLuint));
      workspace_.vertex_source.fill(session_, none, vertices);
    }
    for (const bool who : {false, true}) {
      if (who && label.empty()) break;
      offer(seeds.offers, who);
      ask_triangles(who);
      while (relax(who)) {
      }
    }
    finish(session_, workspace_,
           {buffers_.inside, workspace_.vertex_best, workspace_.vertex_source, mesh_.vertex_count(),
            fields_, mesh_.unit(), options_.radius},
           distance, label);
  }

 private:
  [[nodiscard]] std::size_t cells() const { return fields_ * mesh_.face_count(); }

  void upload(SurfaceBuffers& to) {
    const auto triangles = mesh_.triangles().first(mesh_.face_count());
    to.triangles.reserve(session_, triangles.size_bytes());
    to.triangles.write(session_, triangles);
    to.inside.reserve(session_, mesh_.vertices_inside().size_bytes());
    to.inside.write(session_, mesh_.vertices_inside());
    std::vector<Index> begin = {0}, corners, around;
    for (const Index v : mesh_.pinched()) {
      mesh_.corners_at(v, around);
      corners.insert(corners.end(), around.begin(), around.end());
      begin.push_back(static_cast<Index>(corners.size()));
    }
    if (corners.empty()) return;
    to.pinches.reserve(session_, begin.size() * sizeof(Index));
    to.pinches.write(session_, std::span<const Index>(begin));
    to.corners.reserve(session_, corners.size() * sizeof(Index));
    to.corners.write(session_, std::span<const Index>(corners));
  }

  void set_rule_uniforms(GLuint rule, bool last_resort) const {
    const Uniforms program(session_, rule);
    program.set("triangle_count", mesh_.face_count());
    program.set("radius", radius_);
    program.set("last_resort", std::size_t{last_resort});
    program.set("cells", cells());
  }

  bool pass_pinches() {
    if (mesh_.pinched().empty()) return false;
    return workspace_.front.add(session_, [&] {
      const Uniforms program(session_, session_.program("surface_pinch.comp"));
      program.set("triangle_count", mesh_.face_count());
      program.set("radius", radius_);
      program.set("pinch_count", mesh_.pinched().size());
      program.set("fields", fields_);
      buffers_.triangles.bind(session_, 5);
      buffers_.pinches.bind(session_, 6);
      buffers_.corners.bind(session_, 7);
      dispatch(session_, fields_ * mesh_.pinched().size());
    });
  }

  // Where dropped updates leave triangles without a label, they are taken after all.
  bool revive() {
    if (workspace_.front.state().reached == cells() ||
        radius_ < std::numeric_limits<float>::infinity())
      return false;
    return workspace_.front.add(session_, [&] {
      const GLuint rule = session_.program("surface_round.comp", "#define PLEXWAY_REVIVE\n");
      set_rule_uniforms(rule, true);
      buffers_.triangles.bind(session_, 5);
      session_.gl.UseProgram(rule);
      dispatch(session_, 2 * cells());
    });
  }

  void offer(const std::vector<VertexOffer>& offers, bool who) {
    const Uniforms program(session_, session_.program("claim.comp"));
    program.set("count", offers.size());
    program.set("who", std::size_t{who});
    workspace_.small.write(session_, std::span<const VertexOffer>(offers));
    workspace_.small.bind(session_, 3);
    bind_vertices();
    dispatch(session_, offers.size());
  }

  void ask_triangles(bool who) {
    workspace_.front.bind(session_);
    const Uniforms program(session_, session_.program("surface_read_out.comp"));
    set_read_out_uniforms(program, who);
    dispatch(session_, cells());
  }

  // True if it changed something.
  bool relax(bool who) {
    const Uniforms program(session_, session_.program("surface_relax.comp"));
    set_read_out_uniforms(program, who);
    workspace_.small.fill(session_, 0, 1);
    workspace_.small.bind(session_, 4);
    dispatch(session_, cells());
    GLuint changes = 0;
    workspace_.small.read(session_, std::span<GLuint>(&changes, 1));
    return changes != 0;
  }

  void set_read_out_uniforms(const Uniforms& program, bool who) {
    program.set("triangle_count", mesh_.face_count());
    program.set("cells", cells());
    program.set("vertex_count", mesh_.vertex_count());
    program.set("who", std::size_t{who});
    buffers_.triangles.bind(session_, 5);
    bind_vertices();
  }

  void bind_vertices() {
    workspace_.vertex_best.bind(session_, 6);
    workspace_.vertex_source.bind(session_, 7);
  }

  const GL& executor_;
  const TriangleMesh<float>& mesh_;
  const PropagateOptions& options_;
  Implementation& workspace_;
  const Session& session_;
  SurfaceBuffers& buffers_;
  float radius_;
  std::size_t fields_ = 1;
};

}  // namespace

void propagate(GL executor, const TriangleMesh<float>& mesh, std::span<const PointSource> sources,
               const PropagateOptions& options, GLWorkspace& workspace,
               DistanceField<float>& field) {
  check(sources, options, {mesh.vertex_count(), mesh.face_count(), "face", 3});
  check_options(options, sources.size());
  Implementation& there = workspace.implementation();
  there.use(Context::of(executor.device));
  SurfaceSeeds seeds;
  seeds.add(mesh, sources, 0, there.host);
  const Session session(*there.context);
  SurfaceRun run(executor, mesh, options, there, session);
  field.complete = run.run(seeds, 1);
  field.distance.resize(mesh.vertex_count());
  field.label.resize(sources.size() > 1 ? mesh.vertex_count() : 0);
  run.read_out(seeds, field.distance, field.label);
  set_offsets(sources, options, field.distance);
  const FrontControl& state = there.front.state();
  field.statistics = {FrontControl::wide(state.expansions), FrontControl::wide(state.updates),
                      state.reached};
}

bool propagate_each(GL executor, const TriangleMesh<float>& mesh,
                    std::span<const PointSource> sources, const PropagateOptions& options,
                    GLWorkspace& workspace, std::span<float> distance) {
  const std::size_t vertices = mesh.vertex_count();
  check(sources, options, {vertices, mesh.face_count(), "face", 3});
  check_options(options, sources.size());
  check_size(distance, sources.size(), vertices);
  Implementation& there = workspace.implementation();
  there.use(Context::of(executor.device));
  const Session session(*there.context);
  SurfaceRun run(executor, mesh, options, there, session);
  const std::size_t most = fields_at_once(session, executor, sources.size(), mesh.face_count(),
                                          sizeof(SurfaceLabel), vertices);
  SurfaceSeeds seeds;
  bool complete = true;
  for (std::size_t first = 0; first < sources.size(); first += most) {
    const auto some = sources.subspan(first, std::min(most, sources.size() - first));
    seeds.clear();
    for (std::size_t k = 0; k < some.size(); ++k)
      seeds.add(mesh, some.subspan(k, 1), k, there.host);
    complete &= run.run(seeds, some.size());
    run.read_out(seeds, distance.subspan(first * vertices, some.size() * vertices), {});
  }
  for (std::size_t k = 0; k < sources.size(); ++k)
    set_offsets(sources.subspan(k, 1), options, distance.subspan(k * vertices, vertices));
  return complete;
}

}  // namespace plexway
