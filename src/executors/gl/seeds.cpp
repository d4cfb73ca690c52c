#include "executors/gl/seeds.hpp"

#include <algorithm>
#include <bit>
#include <iterator>
#include <limits>

#include "labels/read_out.hpp"
#include "labels/simplicial/simplex_propagation.hpp"
#include "labels/surface/saddle_rule.hpp"
#include "labels/surface/triangle_propagation.hpp"
#include "labels/wavefront.hpp"

namespace plexway::detail::gl {
namespace {

using SolidLabel = SimplexLabel<float, 3>;
using Wave = Wavefront<float, SolidLabel, DualQueue<float>, true>;

// The serial rule in the host's workspace, in which labels wait until they are taken to the device.
class HostFront {
 public:
  HostFront(const TetMesh<float>& mesh, const PropagateOptions& options,
            WorkspaceState<float>& workspace)
      : front_(make(mesh, options, workspace)), propagation(mesh, front_, options) {}

  void know(Index t, GLuint distance, const SolidCell& cell) {
    SolidLabel label;
    std::copy(cell.distance2.begin(), cell.distance2.end(), label.distance2);
    label.sigma = cell.sigma;
    label.centre = std::bit_cast<float>(distance);
    front_.accept(t, cell.state & SolidCell::face_mask, label, label.centre, cell.source);
  }

  /// What is known of all tetrahedra of a field.
  void know(std::span<const Cell> best, std::span<const SolidCell> known) {
    for (Index t = 0; t < best.size(); ++t)
      if (best[t].known != FrontControl::unreached) know(t, best[t].known, known[t]);
    drain([](Index, GLuint, const SolidCell&) {});
  }

  /// Takes what waits.
  template <class Take>
  void drain(const Take& take) {
    Index t = 0;
    const auto distance_of = [&](Index u) { return front_.label(u).centre; };
    do {
      while (front_.next(t, distance_of)) {
        const SolidLabel& label = front_.label(t);
        SolidCell cell = {{},
                          static_cast<GLuint>(front_.hinge(t)) | SolidCell::known,
                          label.sigma,
                          0,
                          front_.source(t)};
        std::copy(std::begin(label.distance2), std::end(label.distance2), cell.distance2.begin());
        take(t, std::bit_cast<GLuint>(label.centre), cell);
      }
    } while (front_.take_stock(0));
  }

 private:
  static Wave make(const TetMesh<float>& mesh, const PropagateOptions& options,
                   WorkspaceState<float>& workspace) {
    const std::size_t tets = mesh.tet_count();
    workspace.front.reserve(tets);
    workspace.start(tets, true);
    return Wave(workspace.marks, workspace.simplex.reserve<3>(tets + 1),
                DualQueue<float>(workspace.front, std::numeric_limits<float>::infinity()),
                workspace.source.data(), tets, mesh.unit(), options);
  }

  Wave front_;

 public:
  SimplexPropagation<TetMesh<float>, Wave> propagation;
};

PropagateOptions without_limits(const PropagateOptions& options) {
  PropagateOptions all = options;
  all.max_expansions = std::numeric_limits<std::size_t>::max();
  all.progress = {};
  return all;
}

}  // namespace

void SurfaceSeeds::add(const TriangleMesh<float>& mesh, std::span<const PointSource> sources,
                       std::size_t field, WorkspaceState<float>& workspace) {
  const std::size_t faces = mesh.face_count(), first_cell = field * faces;
  const std::size_t first_vertex = field * mesh.vertex_count();
  const PropagateOptions options;
  using Wave = Wavefront<float, SaddleLabel<float>, DualQueue<float>, true>;
  using Rule = SaddleRule<float, Wave>;
  workspace.front.reserve(faces);
  workspace.start(faces, true);
  Wave front(workspace.marks, workspace.saddles.reserve(faces + 1),
             DualQueue<float>(workspace.front, std::numeric_limits<float>::infinity()),
             workspace.source.data(), faces, mesh.unit(), options);
  const Rule rule(mesh.triangles(), front, false);
  TrianglePropagation<float, Rule, Wave, true> propagation(mesh, workspace, rule, front, options);
  for (std::size_t n = 0; n < sources.size(); ++n)
    propagation.seed(sources[n], static_cast<Index>(n));

  front.drain([&](Index f) {
    const SaddleLabel<float>& label = front.label(f);
    const auto via = static_cast<GLuint>(front.hinge(f) | std::size_t{front.source(f)} << 2);
    waiting.push_back(
        {static_cast<GLuint>(first_cell + f), std::bit_cast<GLuint>(label.distance())});
    labels.push_back({{label.x[0], label.x[1], label.x[2], label.x[3]},
                      label.h[0],
                      via,
                      {label.h[2], label.h[3]}});
  });

  // The sources themselves, exactly, and the corners of triangles they lie in.
  for (std::size_t n = 0; n < sources.size(); ++n)
    offer_source(mesh, sources[n], [&](Index v, double d) {
      offers.push_back({static_cast<GLuint>(first_vertex + v),
                        std::bit_cast<GLuint>(static_cast<float>(d)), static_cast<GLuint>(n), 0});
    });
}

void SolidSeeds::add(const TetMesh<float>& mesh, std::span<const PointSource> sources,
                     std::size_t field, WorkspaceState<float>& workspace) {
  const PropagateOptions options;
  HostFront host(mesh, options, workspace);
  for (std::size_t n = 0; n < sources.size(); ++n) {
    host.propagation.seed(sources[n], static_cast<Index>(n));
    offer_corners(mesh, sources[n], [&](Index v, double d) {
      offers.push_back({static_cast<GLuint>(field * mesh.vertex_count() + v),
                        std::bit_cast<GLuint>(static_cast<float>(d)), static_cast<GLuint>(n), 0});
    });
  }
  host.drain([&](Index t, GLuint distance, const SolidCell& cell) {
    waiting.push_back({static_cast<GLuint>(field * mesh.tet_count() + t), distance});
    labels.push_back(cell);
  });
}

void SolidSeeds::add_pinches(const TetMesh<float>& mesh, const PropagateOptions& options,
                             std::size_t field, std::span<const Cell> best,
                             std::span<const SolidCell> known, WorkspaceState<float>& workspace) {
  const std::size_t tets = mesh.tet_count(), first = field * tets;
  const PropagateOptions all = without_limits(options);
  HostFront host(mesh, all, workspace);
  host.know(best.subspan(first, tets), known.subspan(first, tets));
  if (!host.propagation.pass_pinches()) return;
  host.drain([&](Index t, GLuint distance, const SolidCell& cell) {
    waiting.push_back({static_cast<GLuint>(first + t), distance});
    labels.push_back(cell);
  });
}

}  // namespace plexway::detail::gl
