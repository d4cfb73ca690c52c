#include <plexway/executors/serial.hpp>

#include <cmath>
#include <string>

#include <plexway/error.hpp>
#include <plexway/propagate/plain_rule.hpp>
#include <plexway/propagate/saddle_rule.hpp>

#include "propagate/read_out.hpp"
#include "propagate/triangle_propagation.hpp"

namespace plexway {
namespace {

template <class Real>
void check(const TriangleMesh<Real>& mesh, std::span<const PointSource> sources,
           const PropagateOptions& options) {
  if (sources.empty()) throw UsageError("there is no source: name at least one");
  if (sources.size() >= none) throw UsageError("too many sources");
  for (const PointSource& s : sources) {
    if (s.vertex != none) {
      if (s.vertex >= mesh.vertex_count())
        throw UsageError("source vertex " + std::to_string(s.vertex) +
                         " is out of range, there are " + std::to_string(mesh.vertex_count()));
    } else {
      if (s.simplex >= mesh.face_count())
        throw UsageError("source face " + std::to_string(s.simplex) +
                         " is out of range, there are " + std::to_string(mesh.face_count()));
      double sum = 0;
      bool inside = true;
      for (const double b : s.barycentric) inside = inside && b >= 0, sum += b;
      if (!inside || s.barycentric[3] != 0 || !(std::abs(sum - 1) < 1e-6))
        throw UsageError("a source's barycentric coordinates must be >= 0 and sum to 1");
    }
    if (!(s.offset >= 0) || !std::isfinite(s.offset))
      throw UsageError("a source's offset must be a number >= 0");
  }
  if (!(options.step > 0)) throw UsageError("the step must be > 0");
  if (!(options.radius >= 0)) throw UsageError("the radius must be >= 0");
}

// The sources themselves, exactly, and the corners of triangles they lie in.
template <class Real, bool kLabels>
void read_out_sources(const TriangleMesh<Real>& mesh, std::span<const PointSource> sources,
                      Workspace<Real>& workspace) {
  const auto offer = [&](Index v, double d, std::size_t number) {
    if (!(static_cast<Real>(d) < workspace.vertex[v]) &&
        !(kLabels && static_cast<Real>(d) == workspace.vertex[v]))
      return;
    workspace.vertex[v] = static_cast<Real>(d);
    if constexpr (kLabels) workspace.vertex_source[v] = static_cast<Index>(number);
  };
  for (std::size_t n = sources.size(); n-- > 0;) {
    const double sigma = sources[n].offset / mesh.unit();
    if (sources[n].vertex != none) {
      offer(mesh.inside_vertex(sources[n].vertex), sigma, n);
      continue;
    }
    const auto [f, turned] = mesh.inside_face(sources[n].simplex);
    const TriangleRecord<Real>& t = mesh.triangles()[f];
    std::array<double, 4> b = sources[n].barycentric;
    if (turned) std::swap(b[1], b[2]);
    const double px[3] = {0, static_cast<double>(t.length[0]), static_cast<double>(t.apex_x(0))};
    const double py[3] = {0, 0, static_cast<double>(t.apex_h(0))};
    const double x = b[1] * px[1] + b[2] * px[2], y = b[2] * py[2];
    for (std::size_t i = 0; i < 3; ++i)
      offer(t.corner[i], b[i] == 1 ? sigma : sigma + std::hypot(px[i] - x, py[i] - y), n);
  }
}

template <class Real, bool kLabels, class Rule, class Front>
void solve(const TriangleMesh<Real>& mesh, std::span<const PointSource> sources,
           const PropagateOptions& options, Workspace<Real>& workspace, const Rule& rule,
           Wavefront<Real, Front, kLabels>& front, DistanceField<Real>& field) {
  using Propagation = TrianglePropagation<Real, Rule, Wavefront<Real, Front, kLabels>, kLabels>;
  Propagation propagation(mesh, workspace, rule, front, options);
  for (std::size_t n = 0; n < sources.size(); ++n)
    propagation.seed(sources[n], static_cast<Index>(n));
  propagation.run();

  constexpr Real infinity = std::numeric_limits<Real>::infinity();
  const std::size_t vertices = mesh.vertex_count();
  workspace.vertex.assign(vertices, infinity);
  if constexpr (kLabels) workspace.vertex_source.assign(vertices, none);
  if constexpr (requires { rule.label(0).x; })
    read_out_apexes<Real, kLabels>(mesh.triangles(), rule, front, workspace);
  else
    read_out_corners<Real, kLabels>(mesh.triangles(), rule, front, workspace);
  read_out_sources<Real, kLabels>(mesh, sources, workspace);
  if (options.visibility == Visibility::saddles) read_out_edges<Real, kLabels>(mesh, workspace);

  field.distance.resize(vertices);
  field.label.resize(kLabels ? vertices : 0);
  const Real unit = static_cast<Real>(mesh.unit()), radius = static_cast<Real>(options.radius);
  const std::span<const Index> inside = mesh.vertices_inside();
  const bool bounded = radius < infinity || front.out_of_budget();
  for (std::size_t v = 0; v < vertices; ++v) {
    Real d = workspace.vertex[inside[v]];
    // Without a radius, whole fans are reached or not; so one of its corners tells of a vertex,
    // unless fans only touch there.
    if (!(d < infinity) && mesh.corner_at(inside[v]) != none &&
        (bounded || !mesh.pinched().empty() || front.reached(mesh.corner_at(inside[v]) / 3)))
        [[unlikely]] {
      read_out_around<Real, kLabels>(mesh, rule, front, inside[v], workspace);
      d = workspace.vertex[inside[v]];
    }
    d *= unit;
    const bool in = d <= radius;
    field.distance[v] = in ? d : infinity;
    if constexpr (kLabels)
      field.label[v] = in && d < infinity ? workspace.vertex_source[inside[v]] : none;
  }
  // An offset survives scaling exactly.
  for (const PointSource& s : sources)
    if (s.vertex != none && s.offset <= options.radius)
      field.distance[s.vertex] = std::min(field.distance[s.vertex], static_cast<Real>(s.offset));
  field.complete = !front.out_of_budget();
  field.statistics = {front.expansions(), front.updates(), front.reached_count()};
}

template <class Real, bool kLabels, class Front>
void with_front(const TriangleMesh<Real>& mesh, std::span<const PointSource> sources,
                const PropagateOptions& options, Workspace<Real>& workspace, Front front,
                DistanceField<Real>& field) {
  const std::size_t records = mesh.face_count() + 1;
  workspace.marks.resize(records);
  workspace.marks.start();
  workspace.marks.data()[mesh.face_count()] = workspace.marks.current();  // the sentinel
  if constexpr (kLabels) workspace.source.resize(records);
  Wavefront<Real, Front, kLabels> wave(workspace.marks, front, workspace.source.data(),
                                       mesh.face_count(), mesh.unit(), options);
  if (options.visibility == Visibility::saddles) {
    const SaddleRule<Real, decltype(wave)> rule(
        mesh.triangles(), workspace.saddles.reserve(records), wave, options.vectorised);
    solve<Real, kLabels>(mesh, sources, options, workspace, rule, wave, field);
  } else {
    const PlainRule<Real, decltype(wave)> rule(mesh.triangles(), workspace.plain.reserve(records),
                                               wave, options.visibility);
    solve<Real, kLabels>(mesh, sources, options, workspace, rule, wave, field);
  }
}

template <class Real, bool kLabels>
void with_labels(const TriangleMesh<Real>& mesh, std::span<const PointSource> sources,
                 const PropagateOptions& options, Workspace<Real>& workspace,
                 DistanceField<Real>& field) {
  workspace.front.reserve(mesh.face_count());
  const Real infinity = std::numeric_limits<Real>::infinity();
  if (options.schedule == Schedule::priority)
    with_front<Real, kLabels>(mesh, sources, options, workspace,
                              PriorityQueue<Real>(workspace.front), field);
  else
    with_front<Real, kLabels>(
        mesh, sources, options, workspace,
        DualQueue<Real>(workspace.front, options.schedule == Schedule::fifo
                                             ? infinity
                                             : static_cast<Real>(options.step)),
        field);
}

}  // namespace

template <class Real>
void propagate(Serial, const TriangleMesh<Real>& mesh, std::span<const PointSource> sources,
               const PropagateOptions& options, Workspace<Real>& workspace,
               DistanceField<Real>& field) {
  check(mesh, sources, options);
  if (sources.size() > 1)
    with_labels<Real, true>(mesh, sources, options, workspace, field);
  else
    with_labels<Real, false>(mesh, sources, options, workspace, field);
}

template <class Real>
DistanceField<Real> propagate(Serial executor, const TriangleMesh<Real>& mesh,
                              std::span<const PointSource> sources,
                              const PropagateOptions& options) {
  Workspace<Real> workspace;
  DistanceField<Real> field;
  propagate(executor, mesh, sources, options, workspace, field);
  return field;
}

template void propagate(Serial, const TriangleMesh<float>&, std::span<const PointSource>,
                        const PropagateOptions&, Workspace<float>&, DistanceField<float>&);
template void propagate(Serial, const TriangleMesh<double>&, std::span<const PointSource>,
                        const PropagateOptions&, Workspace<double>&, DistanceField<double>&);
template DistanceField<float> propagate(Serial, const TriangleMesh<float>&,
                                        std::span<const PointSource>, const PropagateOptions&);
template DistanceField<double> propagate(Serial, const TriangleMesh<double>&,
                                         std::span<const PointSource>, const PropagateOptions&);

}  // namespace plexway
