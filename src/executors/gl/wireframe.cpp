#include <bit>
#include <vector>

#include <plexway/executors/gl.hpp>

#include "executors/checks.hpp"
#include "executors/gl/run.hpp"
#include "executors/run.hpp"
#include "labels/wireframe/wire_propagation.hpp"

namespace plexway {
using namespace detail;
namespace {

using namespace gl;

struct WireBuffers final : GLWorkspace::Implementation::DomainBuffers {
  Buffer rows{"rows of edges"}, arcs{"edges"}, inside{"vertex numbers"};

  std::vector<Buffer*> all() override { return {&rows, &arcs, &inside}; }
};

// A label is the number of its source.
struct WireSeeds : SeedsOf<GLuint> {
  void add(const Wireframe<float>& wireframe, std::span<const PointSource> from, std::size_t field,
           WorkspaceState<float>&) {
    const std::size_t first = field * wireframe.vertex_count();
    for (std::size_t n = 0; n < from.size(); ++n)
      offer_source(wireframe, from[n], [&](Index v, double sigma) {
        waiting.push_back(
            {static_cast<GLuint>(first + v), std::bit_cast<GLuint>(static_cast<float>(sigma))});
        labels.push_back(static_cast<GLuint>(n));
      });
  }
};

class WireRun : public RunOn<Wireframe<float>, WireBuffers> {
 public:
  using Seeds = WireSeeds;

  static std::size_t cells(const Domain& wireframe) { return wireframe.vertex_count(); }

  WireRun(const Domain& wireframe, const Job& job) : RunOn(wireframe, job, upload) {}

  bool run(const WireSeeds& seeds, std::size_t fields) {
    fields_ = fields;
    const Session& session = job_.session;
    Front& front = job_.workspace.front;
    const std::size_t cells = fields * domain_.vertex_count();
    job_.start(cells, sizeof(GLuint), fields, job_.options.step * domain_.typical_edge());
    front.seed<GLuint>(session, seeds.waiting, seeds.labels);
    const GLuint rule = session.program("wire_round.comp");
    const Uniforms program(session, rule);
    program.set("vertex_count", domain_.vertex_count());
    program.set("radius", static_cast<float>(job_.options.radius / domain_.unit()));
    buffers_.rows.bind(session, 5);
    buffers_.arcs.bind(session, 6);
    const bool complete =
        front.spread(session, rule, session.context().group(), "#define PLEXWAY_WIRES\n",
                     reporter(job_.options, cells, domain_.unit()));
    job_.workspace.rounds = front.state().rounds;
    return complete;
  }

  void read_out(const WireSeeds&, std::span<float> distance, std::span<Index> label) {
    const Front& front = job_.workspace.front;
    finish(job_,
           {buffers_.inside, front.cells(), sizeof(Cell) / sizeof(GLuint), front.labels(),
            domain_.vertex_count(), fields_, domain_.unit()},
           distance, label);
  }

 private:
  static void upload(const Session& session, const Domain& wireframe, WireBuffers& to) {
    to.rows.upload(session, wireframe.begin());
    to.arcs.upload(session, wireframe.arcs());
    to.inside.upload(session, wireframe.vertices_inside());
  }
};

}  // namespace

PLEXWAY_COMPILE_GL(WireRun)

}  // namespace plexway
