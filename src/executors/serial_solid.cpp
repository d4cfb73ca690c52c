#include <plexway/executors/serial_solid.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string>
#include <type_traits>

#include <plexway/error.hpp>
#include <plexway/propagate/plain_solid_rule.hpp>
#include <plexway/propagate/solid_rule.hpp>

#include "executors/checks.hpp"
#include "propagate/finish.hpp"
#include "propagate/solid_propagation.hpp"
#include "propagate/solid_read_out.hpp"

namespace plexway {
namespace {

// The sources themselves, exactly, and the corners of tetrahedra they lie in.
template <class Real, bool kLabels>
void read_out_sources(const TetMesh<Real>& mesh, std::span<const PointSource> sources,
                      Workspace<Real>& workspace) {
  for (std::size_t n = sources.size(); n-- > 0;)
    offer_corners(mesh, sources[n], [&](Index v, double d) {
      const Real distance = static_cast<Real>(d);
      if (distance > workspace.vertex[v]) return;
      workspace.vertex[v] = distance;
      if constexpr (kLabels) workspace.vertex_source[v] = static_cast<Index>(n);
    });
}

template <class Real, bool kLabels, class Rule, class Front>
void solve(const TetMesh<Real>& mesh, std::span<const PointSource> sources,
           const PropagateOptions& options, Workspace<Real>& workspace, const Rule& rule,
           Front& front, DistanceField<Real>& field) {
  SolidPropagation<Real, Rule, Front> propagation(mesh, rule, front, options);
  for (std::size_t n = 0; n < sources.size(); ++n)
    propagation.seed(sources[n], static_cast<Index>(n));
  propagation.run();

  constexpr Real infinity = std::numeric_limits<Real>::infinity();
  const std::size_t vertices = mesh.vertex_count();
  workspace.vertex.assign(vertices, infinity);
  workspace.vertex_path.assign(vertices, 0);
  if constexpr (kLabels) workspace.vertex_source.assign(vertices, none);
  read_out_tets<Real, kLabels>(mesh, rule, front, workspace);
  read_out_sources<Real, kLabels>(mesh, sources, workspace);
  // The full rule is exact where nothing bends a path.
  constexpr bool plain = std::is_same_v<Rule, PlainSolidRule<Real, Front>>;
  if (plain || rule.drops()) read_out_tet_edges<Real, kLabels>(mesh, workspace);

  finish<Real, kLabels>(mesh, sources, options, front, workspace, field);
}

template <class Real, bool kLabels, class Queue>
void with_front(const TetMesh<Real>& mesh, std::span<const PointSource> sources,
                const PropagateOptions& options, Workspace<Real>& workspace, Queue queue,
                DistanceField<Real>& field) {
  workspace.start(mesh.tet_count(), kLabels);
  const std::size_t records = mesh.tet_count() + 1;
  const auto front = [&](auto* labels) {
    return Wavefront<Real, std::remove_pointer_t<decltype(labels)>, Queue, kLabels>(
        workspace.marks, labels, queue, workspace.source.data(), mesh.tet_count(), mesh.unit(),
        options);
  };
  if (mesh.embedded() && options.visibility == Visibility::saddles) {
    auto wave = front(workspace.solids.reserve(records));
    const SolidRule<Real, decltype(wave)> rule(mesh, wave);
    solve<Real, kLabels>(mesh, sources, options, workspace, rule, wave, field);
  } else {
    auto wave = front(workspace.plain_solids.reserve(records));
    const PlainSolidRule<Real, decltype(wave)> rule(mesh, wave, options.visibility);
    solve<Real, kLabels>(mesh, sources, options, workspace, rule, wave, field);
  }
}

template <class Real, bool kLabels>
void with_labels(const TetMesh<Real>& mesh, std::span<const PointSource> sources,
                 const PropagateOptions& options, Workspace<Real>& workspace,
                 DistanceField<Real>& field) {
  workspace.front.reserve(mesh.tet_count());
  with_queue<Real>(options, workspace.front, [&](auto queue) {
    with_front<Real, kLabels>(mesh, sources, options, workspace, queue, field);
  });
}

}  // namespace

template <class Real>
void propagate(Serial, const TetMesh<Real>& mesh, std::span<const PointSource> sources,
               const PropagateOptions& options, Workspace<Real>& workspace,
               DistanceField<Real>& field) {
  check(sources, options, {mesh.vertex_count(), mesh.tet_count(), "tet", 4});
  if (options.visibility == Visibility::tuned)
    throw UsageError(
        "the tuned policy is a table for triangles: use saddles, centroid or upper_bound in "
        "solids");
  if (sources.size() > 1)
    with_labels<Real, true>(mesh, sources, options, workspace, field);
  else
    with_labels<Real, false>(mesh, sources, options, workspace, field);
}

template <class Real>
DistanceField<Real> propagate(Serial executor, const TetMesh<Real>& mesh,
                              std::span<const PointSource> sources,
                              const PropagateOptions& options) {
  Workspace<Real> workspace;
  DistanceField<Real> field;
  propagate(executor, mesh, sources, options, workspace, field);
  return field;
}

template void propagate(Serial, const TetMesh<float>&, std::span<const PointSource>,
                        const PropagateOptions&, Workspace<float>&, DistanceField<float>&);
template void propagate(Serial, const TetMesh<double>&, std::span<const PointSource>,
                        const PropagateOptions&, Workspace<double>&, DistanceField<double>&);
template DistanceField<float> propagate(Serial, const TetMesh<float>&, std::span<const PointSource>,
                                        const PropagateOptions&);
template DistanceField<double> propagate(Serial, const TetMesh<double>&,
                                         std::span<const PointSource>, const PropagateOptions&);

}  // namespace plexway
