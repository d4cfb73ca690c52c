#include <algorithm>
#include <limits>

#include <plexway/error.hpp>
#include <plexway/executors/gl.hpp>

#include "executors/checks.hpp"
#include "executors/gl/run.hpp"
#include "executors/gl/solid_seeds.hpp"

namespace plexway {
namespace {

using namespace gl;
using Implementation = GLWorkspace::Implementation;

struct SolidBuffers final : Implementation::DomainBuffers {
  Buffer tets{"tetrahedra"}, points{"vertices"}, reflex{"reflex edges"},
      corners{"corners at vertices"}, inside{"vertex numbers"};

  void release(const Session& session) override {
    for (Buffer* b : {&tets, &points, &reflex, &corners, &inside}) b->release(session);
  }
  [[nodiscard]] std::size_t bytes() const override {
    return tets.bytes() + points.bytes() + reflex.bytes() + corners.bytes() + inside.bytes();
  }
};

// A label on its way to the device, as shaders/solid_add.comp reads it.
struct AddedLabel {
  Waiting waiting;
  std::array<GLuint, 2> spare;
  SolidCell label;
};

template <class T>
void upload(const Session& session, Buffer& to, std::span<const T> values) {
  to.reserve(session, values.size_bytes());
  to.write(session, values);
}

// Several fields in one solid, in one launch.
class SolidRun {
 public:
  SolidRun(const GL& executor, const TetMesh<float>& mesh, const PropagateOptions& options,
           Implementation& workspace, const Session& session)
      : executor_(executor),
        mesh_(mesh),
        options_(options),
        workspace_(workspace),
        session_(session),
        buffers_(workspace.domain_buffers<SolidBuffers>(
            session, mesh.identity(), [&](SolidBuffers& fresh) { upload_to(fresh); })),
        radius_(static_cast<float>(options.radius / mesh.unit())),
        drops_(!mesh.reflex_edges().empty() || !mesh.pinched().empty() ||
               !mesh.pinched_edges().empty()) {}

  /// Until no label waits, in so many fields. False if the budget is spent.
  bool run(const SolidSeeds& seeds, std::size_t fields) {
    fields_ = fields;
    Front& front = workspace_.front;
    const double step = options_.schedule == Schedule::fifo
                            ? std::numeric_limits<double>::infinity()
                            : options_.step;
    front.start(session_, cells(), sizeof(SolidCell), room_for(executor_, cells()), step,
                budget_of(options_, fields));
    front.clear_labels(session_, cells());
    front.seed<SolidCell>(session_, seeds.waiting, seeds.labels);
    const GLuint rule = session_.program("solid_round.comp");
    const GLuint settle = session_.program("solid_settle.comp");
    const auto report = reporter(options_, cells(), mesh_.unit());
    bool complete = true;
    std::size_t repairs = 0;
    do {
      set_rule_uniforms(rule, repairs > 8, 0);
      bind_solid();
      const std::size_t share = session_.context().group() / 4;  // four invocations a label
      complete = front.spread(session_, rule, share, "#define PLEXWAY_SOLIDS\n", report, settle);
    } while (complete && (pass_pinches() || (++repairs < 64 && repair(repairs))));
    workspace_.rounds = front.state().rounds;
    return complete;
  }

  /// Fields times vertices, in the caller's order; `label` may be empty.
  void read_out(const SolidSeeds& seeds, std::span<float> distance, std::span<Index> label) {
    const std::size_t vertices = fields_ * mesh_.vertex_count();
    labels_ = !label.empty();
    workspace_.vertex_best.reserve(session_, vertices * sizeof(GLuint));
    workspace_.vertex_best.fill(session_, FrontControl::unreached, vertices);
    workspace_.small.reserve(session_, 16 + seeds.offers.size() * sizeof(VertexOffer));
    if (labels_) {
      workspace_.vertex_source.reserve(session_, vertices * sizeof(GLuint));
      workspace_.vertex_source.fill(session_, none, vertices);
    }
    offer(seeds.offers, false);
    ask_tets(vertices);
    if (labels_) offer(seeds.offers, true);
    // The full rule is exact where nothing bends a path.
    while (drops_ && relax(false)) {
    }
    while (drops_ && labels_ && relax(true)) {
    }
    finish(session_, workspace_,
           {buffers_.inside, workspace_.vertex_best, workspace_.vertex_source, mesh_.vertex_count(),
            fields_, mesh_.unit(), options_.radius},
           distance, label);
  }

 private:
  [[nodiscard]] std::size_t cells() const { return fields_ * mesh_.tet_count(); }

  void upload_to(SolidBuffers& to) {
    static_assert(sizeof(TetRecord<float>) == 48 && sizeof(ReflexEdge<float>) == 84 &&
                  sizeof(SolidCell) == 48 && sizeof(AddedLabel) == 64);
    upload(session_, to.tets, mesh_.tets().first(mesh_.tet_count()));
    upload(session_, to.points, mesh_.points());
    upload(session_, to.inside, mesh_.vertices_inside());
    const auto edges = mesh_.reflex_edges();
    const auto list = mesh_.reflex_list();
    to.reflex.reserve(session_, edges.size_bytes() + list.size_bytes());
    to.reflex.write(session_, edges);
    to.reflex.write(session_, list, edges.size_bytes() / sizeof(Index));
    std::vector<Index> corners(mesh_.vertex_count() + 1, 0);
    for (Index v = 0; v < mesh_.vertex_count(); ++v) {
      const auto around = mesh_.corners_at(v);
      corners[v + 1] = corners[v] + static_cast<Index>(around.size());
      corners.insert(corners.end(), around.begin(), around.end());
    }
    upload(session_, to.corners, std::span<const Index>(corners));
  }

  void bind_solid() const {
    buffers_.tets.bind(session_, 5);
    buffers_.points.bind(session_, 6);
    buffers_.reflex.bind(session_, 7);
  }

  void set_solid_uniforms(const Uniforms& program) const {
    program.set("tet_count", mesh_.tet_count());
    program.set("reflex_count", mesh_.reflex_edges().size());
    program.set("cells", cells());
    program.set("vertex_count", mesh_.vertex_count());
  }

  void set_rule_uniforms(GLuint rule, bool last_resort, std::size_t repaired_cells) const {
    const Uniforms program(session_, rule);
    set_solid_uniforms(program);
    program.set("radius", radius_);
    program.set("last_resort", std::size_t{last_resort});
    program.set("repair", repaired_cells);
  }

  // Few solids have such places: the host sees to them.
  bool pass_pinches() {
    if (mesh_.pinched().empty() && mesh_.pinched_edges().empty()) return false;
    std::vector<GLuint> best(cells());
    std::vector<SolidCell> known(cells());
    workspace_.front.best().read(session_, std::span<GLuint>(best));
    workspace_.front.labels().read(session_, std::span<SolidCell>(known));
    SolidSeeds found;
    for (std::size_t field = 0; field < fields_; ++field)
      found.add_pinches(mesh_, options_, field, best, known, workspace_.host);
    if (found.waiting.empty()) return false;
    std::vector<AddedLabel> added;
    for (std::size_t n = 0; n < found.waiting.size(); ++n)
      added.push_back({found.waiting[n], {}, found.labels[n]});
    return workspace_.front.add(session_, [&] {
      workspace_.small.reserve(session_, added.size() * sizeof(AddedLabel));
      workspace_.small.write(session_, std::span<const AddedLabel>(added));
      workspace_.small.bind(session_, 5);
      const Uniforms program(session_, session_.program("solid_add.comp"));
      program.set("count", added.size());
      dispatch(session_, added.size());
    });
  }

  // As SolidPropagation's: the last few are not worth another look at all.
  bool repair(std::size_t round) {
    Front& front = workspace_.front;
    if (!drops_ && front.state().reached == cells()) return false;
    const std::size_t before = FrontControl::wide(front.state().updates);
    const bool any = front.add(session_, [&] {
      const GLuint rule = session_.program("solid_round.comp");
      set_rule_uniforms(rule, true, cells());
      bind_solid();
      session_.gl.UseProgram(rule);
      dispatch(session_, 4 * cells());
    });
    const std::size_t repaired = FrontControl::wide(front.state().updates) - before;
    return any && (front.state().spare > 0 || (round < 4 && repaired > cells() / 1024));
  }

  void offer(const std::vector<VertexOffer>& offers, bool who) {
    const Uniforms program(session_, session_.program("claim.comp"));
    program.set("count", offers.size());
    program.set("who", std::size_t{who});
    workspace_.small.write(session_, std::span<const VertexOffer>(offers));
    workspace_.small.bind(session_, 3);
    workspace_.vertex_best.bind(session_, 6);
    if (labels_) workspace_.vertex_source.bind(session_, 7);
    dispatch(session_, offers.size());
  }

  void bind_vertices() {
    workspace_.vertex_best.bind(session_, 0);
    if (labels_) workspace_.vertex_source.bind(session_, 1);
  }

  void ask_tets(std::size_t vertices) {
    const Uniforms program(session_, session_.program("solid_read_out.comp"));
    set_solid_uniforms(program);
    program.set("total", vertices);
    program.set("sources_wanted", std::size_t{labels_});
    bind_vertices();
    workspace_.front.labels().bind(session_, 2);
    buffers_.corners.bind(session_, 3);
    bind_solid();
    dispatch(session_, vertices);
  }

  // True if it changed something.
  bool relax(bool who) {
    const Uniforms program(session_, session_.program("solid_relax.comp"));
    set_solid_uniforms(program);
    program.set("who", std::size_t{who});
    program.set("sources_wanted", std::size_t{labels_});
    bind_vertices();
    workspace_.small.fill(session_, 0, 1);
    workspace_.small.bind(session_, 4);
    bind_solid();
    dispatch(session_, cells());
    GLuint changes = 0;
    workspace_.small.read(session_, std::span<GLuint>(&changes, 1));
    return changes != 0;
  }

  const GL& executor_;
  const TetMesh<float>& mesh_;
  const PropagateOptions& options_;
  Implementation& workspace_;
  const Session& session_;
  SolidBuffers& buffers_;
  float radius_;
  bool drops_;  // can an offer be dropped that another does not make up for?
  bool labels_ = false;
  std::size_t fields_ = 1;
};

// Throws UsageError for what solids on the device are not.
void check_solid(const TetMesh<float>& mesh, std::span<const PointSource> sources,
                 const PropagateOptions& options) {
  check(sources, options, {mesh.vertex_count(), mesh.tet_count(), "tet", 4});
  check_options(options, sources.size());
  if (!mesh.embedded())
    throw UsageError("the gl executor needs coordinates of a solid, not lengths alone: use Serial");
}

}  // namespace

void propagate(GL executor, const TetMesh<float>& mesh, std::span<const PointSource> sources,
               const PropagateOptions& options, GLWorkspace& workspace,
               DistanceField<float>& field) {
  check_solid(mesh, sources, options);
  Implementation& there = workspace.implementation();
  there.use(Context::of(executor.device));
  SolidSeeds seeds;
  seeds.add(mesh, sources, 0, there.host);
  const Session session(*there.context);
  SolidRun run(executor, mesh, options, there, session);
  field.complete = run.run(seeds, 1);
  field.distance.resize(mesh.vertex_count());
  field.label.resize(sources.size() > 1 ? mesh.vertex_count() : 0);
  run.read_out(seeds, field.distance, field.label);
  set_offsets(sources, options, field.distance);
  const FrontControl& state = there.front.state();
  field.statistics = {FrontControl::wide(state.expansions), FrontControl::wide(state.updates),
                      state.reached};
}

bool propagate_each(GL executor, const TetMesh<float>& mesh, std::span<const PointSource> sources,
                    const PropagateOptions& options, GLWorkspace& workspace,
                    std::span<float> distance) {
  const std::size_t vertices = mesh.vertex_count();
  check_solid(mesh, sources, options);
  check_size(distance, sources.size(), vertices);
  Implementation& there = workspace.implementation();
  there.use(Context::of(executor.device));
  const Session session(*there.context);
  SolidRun run(executor, mesh, options, there, session);
  const std::size_t most = fields_at_once(session, executor, sources.size(), mesh.tet_count(),
                                          sizeof(SolidCell), vertices);
  SolidSeeds seeds;
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
