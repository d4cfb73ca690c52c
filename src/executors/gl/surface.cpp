#include <algorithm>
#include <limits>
#include <vector>

#include <plexway/executors/gl.hpp>

#include "executors/checks.hpp"
#include "executors/cloud_field.hpp"
#include "executors/gl/run.hpp"
#include "executors/gl/seeds.hpp"
#include "executors/gl/workspace.hpp"
#include "executors/run.hpp"

namespace plexway {
using namespace detail;

namespace {

using namespace gl;

struct SurfaceBuffers final : GLWorkspace::Implementation::DomainBuffers {
  Buffer triangles{"triangles"}, inside{"vertex numbers"}, pinches{"pinched vertices"},
      corners{"corners at pinched vertices"};

  std::vector<Buffer*> all() override { return {&triangles, &inside, &pinches, &corners}; }
};

class SurfaceRun : public RunOn<TriangleMesh<float>, SurfaceBuffers> {
 public:
  using Seeds = SurfaceSeeds;

  static std::size_t cells(const Domain& mesh) { return mesh.face_count(); }

  SurfaceRun(const Domain& mesh, const Job& job) : RunOn(mesh, job, upload) {}

  bool run(const SurfaceSeeds& seeds, std::size_t fields) {
    fields_ = fields;
    Front& front = workspace_.front;
    job_.start(cells(), sizeof(SurfaceLabel), fields, job_.options.step);
    front.seed<SurfaceLabel>(session_, seeds.waiting, seeds.labels);
    const GLuint rule = session_.program("surface_round.comp");
    const GLuint narrow = session_.program("surface_narrow.comp");
    Uniforms(session_, narrow).set("triangle_count", domain_.face_count());
    const auto report = reporter(job_.options, cells(), domain_.unit());
    bool complete = true;
    int revivals = 0;
    do {
      set_rule_uniforms(rule, revivals > 8);
      buffers_.triangles.bind(session_, 5);
      const std::size_t share = session_.context().group() / 2;  // two invocations a label
      complete = front.spread(session_, rule, share, "", report, narrow);
      ++revivals;
    } while (complete && (pass_pinches() || revive()));
    workspace_.rounds = front.state().rounds;
    return complete;
  }

  void read_out(const SurfaceSeeds& seeds, std::span<float> distance, std::span<Index> label) {
    const bool labels = !label.empty();
    start_read_out(job_, fields_ * domain_.vertex_count(), seeds.offers.size(), labels);
    for (const bool who : {false, true}) {
      if (who && !labels) break;
      offer_vertices(job_, seeds.offers, who, labels);
      ask_triangles(who);
      while (relax(who)) {
      }
    }
    finish(job_,
           {buffers_.inside, workspace_.vertex_best, 1, workspace_.vertex_source,
            domain_.vertex_count(), fields_, domain_.unit()},
           distance, label);
  }

 private:
  [[nodiscard]] std::size_t cells() const { return fields_ * domain_.face_count(); }

  static void upload(const Session& session, const Domain& mesh, SurfaceBuffers& to) {
    to.triangles.upload(session, mesh.triangles().first(mesh.face_count()));
    to.inside.upload(session, mesh.vertices_inside());
    std::vector<Index> begin = {0}, corners, around;
    for (const Index v : mesh.pinched()) {
      mesh.corners_at(v, around);
      corners.insert(corners.end(), around.begin(), around.end());
      begin.push_back(static_cast<Index>(corners.size()));
    }
    if (corners.empty()) return;
    to.pinches.upload(session, std::span<const Index>(begin));
    to.corners.upload(session, std::span<const Index>(corners));
  }

  void set_rule_uniforms(GLuint rule, bool last_resort) const {
    const Uniforms program(session_, rule);
    program.set("triangle_count", domain_.face_count());
    program.set("radius", radius_);
    program.set("last_resort", std::size_t{last_resort});
    program.set("cell_count", cells());
  }

  bool pass_pinches() {
    if (domain_.pinched().empty()) return false;
    return 0 < workspace_.front.add(session_, [&] {
      const Uniforms program(session_, session_.program("surface_pinch.comp"));
      program.set("triangle_count", domain_.face_count());
      program.set("radius", radius_);
      program.set("pinch_count", domain_.pinched().size());
      program.set("fields", fields_);
      buffers_.triangles.bind(session_, 5);
      buffers_.pinches.bind(session_, 6);
      buffers_.corners.bind(session_, 7);
      dispatch(session_, fields_ * domain_.pinched().size());
    });
  }

  // Where dropped updates leave triangles without a label, they are taken after all.
  bool revive() {
    if (workspace_.front.state().reached == cells() ||
        radius_ < std::numeric_limits<float>::infinity())
      return false;
    return 0 < workspace_.front.add(session_, [&] {
      const GLuint rule = session_.program("surface_round.comp", "#define PLEXWAY_REVIVE\n");
      set_rule_uniforms(rule, true);
      buffers_.triangles.bind(session_, 5);
      session_.gl.UseProgram(rule);
      dispatch(session_, 2 * cells());
    });
  }

  void ask_triangles(bool who) {
    workspace_.front.bind(session_);
    const Uniforms program(session_, session_.program("surface_read_out.comp"));
    set_read_out_uniforms(program, who);
    dispatch(session_, cells());
  }

  // True if it changed something.
  bool relax(bool who) {
    return changes(job_, [&] {
      const Uniforms program(session_, session_.program("surface_relax.comp"));
      set_read_out_uniforms(program, who);
      dispatch(session_, cells());
    });
  }

  void set_read_out_uniforms(const Uniforms& program, bool who) {
    program.set("triangle_count", domain_.face_count());
    program.set("cell_count", cells());
    program.set("vertex_count", domain_.vertex_count());
    program.set("who", std::size_t{who});
    buffers_.triangles.bind(session_, 5);
    workspace_.vertex_best.bind(session_, 6);
    workspace_.vertex_source.bind(session_, 7);
  }
};

}  // namespace

PLEXWAY_COMPILE_GL(SurfaceRun)

void solve_points(const GL& executor, const PointCloud<float>& cloud,
                  std::span<const PointSource> sources, const PropagateOptions& options,
                  GLWorkspace& workspace, DistanceField<float>& field) {
  solve_on_cloud(executor, cloud, sources, options, workspace.implementation().host.moved,
                 workspace, field);
}

bool each_point(const GL& executor, const PointCloud<float>& cloud,
                std::span<const PointSource> sources, const PropagateOptions& options,
                GLWorkspace& workspace, std::span<float> distance) {
  const std::size_t points = cloud.point_count(), vertices = cloud.surface().vertex_count();
  std::vector<PointSource>& moved = workspace.implementation().host.moved;
  moved = first_at_place(cloud, sources, std::move(moved));
  std::vector<float> rows(vertices == points ? 0 : sources.size() * vertices);
  const bool complete = solve_each(executor, cloud.surface(), moved, options, workspace,
                                   rows.empty() ? distance : std::span<float>(rows));
  for (std::size_t k = 0; k < sources.size() && !rows.empty(); ++k)
    std::copy_n(&rows[k * vertices], points, &distance[k * points]);
  for (std::size_t k = 0; k < sources.size(); ++k)
    for (const auto& [twin, first] : cloud.twins())
      distance[k * points + twin] = distance[k * points + first];
  return complete;
}

PLEXWAY_COMPILE(GL, PointCloud<float>)

}  // namespace plexway
