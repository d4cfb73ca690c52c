#include <vector>

#include <plexway/error.hpp>
#include <plexway/executors/gl.hpp>

#include "executors/checks.hpp"
#include "executors/gl/solid_seeds.hpp"
#include "executors/gl/solve.hpp"
#include "executors/run.hpp"

namespace plexway {
namespace {

using namespace gl;

struct SolidBuffers final : GLWorkspace::Implementation::DomainBuffers {
  Buffer tets{"tetrahedra"}, points{"vertices"}, reflex{"reflex edges"},
      corners{"corners at vertices"}, inside{"vertex numbers"};

  std::vector<Buffer*> all() override { return {&tets, &points, &reflex, &corners, &inside}; }
};

// A label on its way to the device, as shaders/solid_add.comp reads it.
struct AddedLabel {
  Waiting waiting;
  GLuint spare;
  SolidCell label;
};

// Several fields in one solid, in one launch.
class SolidRun {
 public:
  using Domain = TetMesh<float>;
  using Seeds = SolidSeeds;

  static void check(const Domain& mesh, std::span<const PointSource> sources,
                    const PropagateOptions& options) {
    plexway::check(sources, options, mesh);
    check_number(sources.size());
  }
  static std::size_t cells(const Domain& mesh) { return mesh.tet_count(); }

  SolidRun(const Domain& mesh, const Job& job)
      : job_(job),
        mesh_(mesh),
        workspace_(job.workspace),
        session_(job.session),
        buffers_(workspace_.domain_buffers<SolidBuffers>(
            session_, mesh.identity(), [&](SolidBuffers& fresh) { upload(fresh); })),
        radius_(static_cast<float>(job.options.radius / mesh.unit())),
        drops_(!mesh.reflex_edges().empty() || !mesh.pinched().empty() ||
               !mesh.pinched_edges().empty() || mesh.summary().degenerate_tets > 0) {}

  /// Until no label waits, in so many fields. False if the budget is spent.
  bool run(const SolidSeeds& seeds, std::size_t fields) {
    fields_ = fields;
    Front& front = workspace_.front;
    job_.start(cells(), sizeof(SolidCell), fields, job_.options.step);
    front.clear_labels(session_, cells());
    front.seed<SolidCell>(session_, seeds.waiting, seeds.labels);
    const GLuint rule = session_.program("solid_round.comp");
    const auto report = reporter(job_.options, cells(), mesh_.unit());
    bool complete = true;
    std::size_t repairs = 0;
    do {
      set_rule_uniforms(rule, repairs > 8, 0);
      bind_solid();
      const std::size_t share = session_.context().group() / 4;  // four invocations a label
      complete = front.spread(session_, rule, share, "#define PLEXWAY_SOLIDS\n", report);
    } while (complete && (pass_pinches() || (++repairs < 64 && repair(repairs))));
    workspace_.rounds = front.state().rounds;
    return complete_ = complete;
  }

  /// Fields times vertices, in the caller's order; `label` may be empty.
  void read_out(const SolidSeeds& seeds, std::span<float> distance, std::span<Index> label) {
    const std::size_t vertices = fields_ * mesh_.vertex_count();
    labels_ = !label.empty();
    start_read_out(job_, vertices, seeds.offers.size(), labels_);
    offer_vertices(job_, seeds.offers, false, labels_);
    ask_tets(vertices);
    if (labels_) offer_vertices(job_, seeds.offers, true, labels_);
    if (labels_ && complete_) pass_borders(seeds, vertices);
    // The full rule is exact where nothing bends a path.
    while (drops_ && relax(false)) {
    }
    while (drops_ && labels_ && relax(true)) {
    }
    finish(job_,
           {buffers_.inside, workspace_.vertex_best, 1, workspace_.vertex_source,
            mesh_.vertex_count(), fields_, mesh_.unit()},
           distance, label);
  }

 private:
  [[nodiscard]] std::size_t cells() const { return fields_ * mesh_.tet_count(); }

  void upload(SolidBuffers& to) {
    static_assert(sizeof(TetRecord<float>) == 48 && sizeof(ReflexEdge<float>) == 84 &&
                  sizeof(SolidCell) == 32 && sizeof(AddedLabel) == 48);
    to.tets.upload(session_, mesh_.tets().first(mesh_.tet_count()));
    to.points.upload(session_, mesh_.points());
    to.inside.upload(session_, mesh_.vertices_inside());
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
    to.corners.upload(session_, std::span<const Index>(corners));
  }

  void bind_solid() const {
    buffers_.tets.bind(session_, 5);
    buffers_.points.bind(session_, 6);
    buffers_.reflex.bind(session_, 7);
  }

  void set_solid_uniforms(const Uniforms& program) const {
    program.set("tet_count", mesh_.tet_count());
    program.set("reflex_count", mesh_.reflex_edges().size());
    program.set("cracks", static_cast<std::size_t>(mesh_.has_crack()));
    program.set("cell_count", cells());
    program.set("vertex_count", mesh_.vertex_count());
  }

  void set_rule_uniforms(GLuint rule, bool last_resort, std::size_t repaired_cells) const {
    const Uniforms program(session_, rule);
    set_solid_uniforms(program);
    program.set("radius", radius_);
    program.set("last_resort", std::size_t{last_resort});
    program.set("repair", repaired_cells);
  }

  // Few solids have such places, or cracks: the host sees to them.
  bool pass_pinches() {
    if (mesh_.pinched().empty() && mesh_.pinched_edges().empty() && !mesh_.has_crack())
      return false;
    std::vector<Cell> best(cells());
    std::vector<SolidCell> known(cells());
    workspace_.front.cells().read(session_, std::span<Cell>(best));
    workspace_.front.labels().read(session_, std::span<SolidCell>(known));
    SolidSeeds found;
    for (std::size_t field = 0; field < fields_; ++field)
      found.add_pinches(mesh_, job_.options, field, best, known, workspace_.host);
    if (found.waiting.empty()) return false;
    std::vector<AddedLabel> added;
    for (std::size_t n = 0; n < found.waiting.size(); ++n)
      added.push_back({found.waiting[n], 0, found.labels[n]});
    return 0 < workspace_.front.add(session_, [&] {
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
    const std::size_t repaired = front.add(session_, [&] {
      const GLuint rule = session_.program("solid_round.comp");
      set_rule_uniforms(rule, true, cells());
      bind_solid();
      session_.gl.UseProgram(rule);
      dispatch(session_, 4 * cells());
    });
    return repaired > 0 && (front.state().spare > 0 || (round < 4 && repaired > cells() / 1024));
  }

  // A front over few vertices, in an order: the host sees to them.
  void pass_borders(const SolidSeeds& seeds, std::size_t vertices) {
    std::vector<Cell> best(cells());
    std::vector<SolidCell> known(cells());
    std::vector<float> distance(vertices);
    std::vector<Index> source(vertices);
    workspace_.front.cells().read(session_, std::span<Cell>(best));
    workspace_.front.labels().read(session_, std::span<SolidCell>(known));
    workspace_.vertex_best.read(session_, std::span<float>(distance));
    workspace_.vertex_source.read(session_, std::span<Index>(source));
    seeds.pass_borders(mesh_, job_.options, best, known, workspace_.host, distance, source);
    workspace_.vertex_best.write(session_, std::span<const float>(distance));
    workspace_.vertex_source.write(session_, std::span<const Index>(source));
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
    workspace_.front.cells().bind(session_, 4);
    bind_solid();
    dispatch(session_, vertices);
  }

  // True if it changed something.
  bool relax(bool who) {
    return changes(job_, [&] {
      const Uniforms program(session_, session_.program("solid_relax.comp"));
      set_solid_uniforms(program);
      program.set("who", std::size_t{who});
      program.set("sources_wanted", std::size_t{labels_});
      bind_vertices();
      bind_solid();
      dispatch(session_, cells());
    });
  }

  const Job job_;
  const Domain& mesh_;
  GLWorkspace::Implementation& workspace_;
  const Session& session_;
  SolidBuffers& buffers_;
  float radius_;
  bool drops_;  // can an offer be dropped that another does not make up for?
  bool labels_ = false;
  bool complete_ = true;
  std::size_t fields_ = 1;
};

}  // namespace

void solve_points(const GL& executor, const TetMesh<float>& domain,
                  std::span<const PointSource> sources, const PropagateOptions& options,
                  GLWorkspace& workspace, DistanceField<float>& field) {
  gl::solve_nearest<SolidRun>(executor, domain, sources, options, workspace, field);
}

bool each_point(const GL& executor, const TetMesh<float>& domain,
                std::span<const PointSource> sources, const PropagateOptions& options,
                GLWorkspace& workspace, std::span<float> distance) {
  return gl::solve_each<SolidRun>(executor, domain, sources, options, workspace, distance);
}

PLEXWAY_COMPILE(GL, TetMesh<float>)

}  // namespace plexway
