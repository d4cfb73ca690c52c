#include "executors/gl/surface_seeds.hpp"

#include <bit>
#include <cmath>
#include <limits>

#include "labels/surface/saddle_rule.hpp"
#include "labels/surface/triangle_propagation.hpp"

namespace plexway::gl {

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
  for (std::size_t n = 0; n < sources.size(); ++n) {
    const PointSource& s = sources[n];
    const double sigma = s.offset / mesh.unit();
    const auto offer = [&](Index v, double d) {
      offers.push_back({static_cast<GLuint>(first_vertex + v),
                        std::bit_cast<GLuint>(static_cast<float>(d)), static_cast<GLuint>(n), 0});
    };
    if (s.vertex != none) {
      offer(mesh.inside_vertex(s.vertex), sigma);
      continue;
    }
    const auto [face, turned] = mesh.inside_face(s.simplex);
    const TriangleRecord<float>& t = mesh.triangles()[face];
    std::array<double, 4> b = s.barycentric;
    if (turned) std::swap(b[1], b[2]);
    const double px[3] = {0, static_cast<double>(t.length[0]), static_cast<double>(t.apex_x(0))};
    const double py[3] = {0, 0, static_cast<double>(t.apex_h(0))};
    const double x = b[1] * px[1] + b[2] * px[2], y = b[2] * py[2];
    for (std::size_t i = 0; i < 3; ++i)
      offer(t.corner[i], b[i] == 1 ? sigma : sigma + std::hypot(px[i] - x, py[i] - y));
  }
}

}  // namespace plexway::gl
