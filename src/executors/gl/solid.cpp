#include <array>
#include <vector>

#include <plexway/error.hpp>
#include <plexway/executors/gl.hpp>

#include "executors/checks.hpp"
#include "executors/gl/run.hpp"
#include "executors/gl/seeds.hpp"
#include "executors/run.hpp"

namespace plexway {
using namespace detail;
namespace {

using namespace gl;

struct SolidBuffers final : GLWorkspace::Implementation::DomainBuffers {
  Buffer tets{"tetrahedra"}, lengths{"lengths"}, corners{"corners at vertices"},
      inside{"vertex numbers"};

  std::vector<Buffer*> all() override { return {&tets, &lengths, &corners, &inside}; }
};

// A label on its way to the device, as shaders/solid_add.comp reads it.
struct AddedLabel {
  Waiting waiting;
  GLuint spare;
  SolidCell label;
};

std::vector<std::array<float, 6>> squared_lengths(const TetMesh<float>& mesh) {
  if (!mesh.embedded()) return {mesh.squared_lengths().begin(), mesh.squared_lengths().end()};
  std::vector<std::array<float, 6>> lengths(mesh.tet_count());
  for (Index t = 0; t < mesh.tet_count(); ++t)
    for (std::size_t e = 0; e < 6; ++e) {
      const Index* const corner = mesh.tets()[t].corner;
      const auto along =
          mesh.points()[corner[tet_edge_ends[e][1]]] - mesh.points()[corner[tet_edge_ends[e][0]]];
      lengths[t][e] = static_cast<float>(dot(along, along));
    }
  return lengths;
}

class SolidRun : public RunOn<TetMesh<float>, SolidBuffers> {
 public:
  using Seeds = SolidSeeds;

  static std::size_t cells(const Domain& mesh) { return mesh.tet_count(); }

  SolidRun(const Domain& mesh, const Job& job) : RunOn(mesh, job, upload) {}

  bool run(const SolidSeeds& seeds, std::size_t fields) {
    fields_ = fields;
    Front& front = workspace_.front;
    job_.start(cells(), sizeof(SolidCell), fields, job_.options.step);
    front.clear_labels(session_, cells());
    front.seed<SolidCell>(session_, seeds.waiting, seeds.labels);
    const GLuint rule = session_.program("solid_round.comp");
    const auto report = reporter(job_.options, cells(), domain_.unit());
    bool complete = true;
    do {
      const Uniforms program(session_, rule);
      set_solid_uniforms(program);
      program.set("radius", radius_);
      bind_solid();
      const std::size_t share = session_.context().group() / 4;  // four invocations a label
      complete = front.spread(session_, rule, share, "#define PLEXWAY_SOLIDS\n", report);
    } while (complete && pass_pinches());
    workspace_.rounds = front.state().rounds;
    return complete;
  }

  void read_out(const SolidSeeds& seeds, std::span<float> distance, std::span<Index> label) {
    const std::size_t vertices = fields_ * domain_.vertex_count();
    labels_ = !label.empty();
    start_read_out(job_, vertices, seeds.offers.size(), labels_);
    offer_vertices(job_, seeds.offers, false, labels_);
    ask_tets(vertices);
    if (labels_) offer_vertices(job_, seeds.offers, true, labels_);
    while (relax(false)) {
    }
    while (labels_ && relax(true)) {
    }
    finish(job_,
           {buffers_.inside, workspace_.vertex_best, 1, workspace_.vertex_source,
            domain_.vertex_count(), fields_, domain_.unit()},
           distance, label);
  }

 private:
  [[nodiscard]] std::size_t cells() const { return fields_ * domain_.tet_count(); }

  static void upload(const Session& session, const Domain& mesh, SolidBuffers& to) {
    static_assert(sizeof(TetRecord) == 32 && sizeof(SolidCell) == 32 && sizeof(AddedLabel) == 48);
    to.tets.upload(session, mesh.tets().first(mesh.tet_count()));
    to.inside.upload(session, mesh.vertices_inside());
    to.lengths.upload(session, std::span<const std::array<float, 6>>(squared_lengths(mesh)));
    std::vector<Index> corners(mesh.vertex_count() + 1, 0);
    for (Index v = 0; v < mesh.vertex_count(); ++v) {
      const auto around = mesh.corners_at(v);
      corners[v + 1] = corners[v] + static_cast<Index>(around.size());
      corners.insert(corners.end(), around.begin(), around.end());
    }
    to.corners.upload(session, std::span<const Index>(corners));
  }

  void bind_solid() const {
    buffers_.tets.bind(session_, 5);
    buffers_.lengths.bind(session_, 6);
  }

  void set_solid_uniforms(const Uniforms& program) const {
    program.set("tet_count", domain_.tet_count());
    program.set("cell_count", cells());
    program.set("vertex_count", domain_.vertex_count());
  }

  // Few solids have such places: the host sees to them.
  bool pass_pinches() {
    if (domain_.pinched().empty() && domain_.pinched_edges().empty()) return false;
    std::vector<Cell> best(cells());
    std::vector<SolidCell> known(cells());
    workspace_.front.cells().read(session_, std::span<Cell>(best));
    workspace_.front.labels().read(session_, std::span<SolidCell>(known));
    SolidSeeds found;
    for (std::size_t field = 0; field < fields_; ++field)
      found.add_pinches(domain_, job_.options, field, best, known, workspace_.host);
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

  bool labels_ = false;
};

}  // namespace

PLEXWAY_COMPILE_GL(SolidRun)

}  // namespace plexway
