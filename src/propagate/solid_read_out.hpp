#pragma once

#include <limits>
#include <span>
#include <utility>

#include <plexway/complex/tet_mesh.hpp>
#include <plexway/propagate/workspace.hpp>

namespace plexway {

/// Every corner of every reached tetrahedron offers a distance; vertices keep the least. Of those
/// around a vertex that came the same way, one is asked.
template <class Real, bool kLabels, class Rule, class Front>
void read_out_tets(const TetMesh<Real>& mesh, const Rule& rule, const Front& front,
                   Workspace<Real>& workspace) {
  const std::span<const TetRecord<Real>> tets = mesh.tets();
  for (Index t = 0; t + 1 < tets.size(); ++t) {
    if (!front.reached(t)) continue;
    const Index path = rule.path(t);
    for (Index i = 0; i < 4; ++i) {
      const Index v = tets[t].corner[i];
      if (workspace.vertex_path[v] == path && path != 0) continue;
      const Real d = rule.corner_distance(t, i, workspace.vertex[v]);
      if (!(d < workspace.vertex[v])) continue;
      workspace.vertex[v] = d;
      workspace.vertex_path[v] = path;
      if constexpr (kLabels) workspace.vertex_source[v] = front.source(t);
    }
  }
}

/// No vertex is farther than a neighbour and the edge between.
template <class Real, bool kLabels>
void read_out_tet_edges(const TetMesh<Real>& mesh, Workspace<Real>& workspace) {
  const std::span<const TetRecord<Real>> tets = mesh.tets();
  const std::span<const Vector3<Real>> points = mesh.points();
  Real* d = workspace.vertex.data();
  for (std::size_t t = 0; t + 1 < tets.size(); ++t)
    for (const auto& ends : tet_edge_ends) {
      // Most need no change, and whichever end is nearer: that cannot be predicted.
      Index v = tets[t].corner[ends[0]], w = tets[t].corner[ends[1]];
      const Vector3<Real> e = points[w] - points[v];
      const Real rise = d[w] - d[v];
      if (rise * rise <= dot(e, e)) [[likely]]
        continue;
      if (d[w] < d[v]) std::swap(v, w);
      if (!(d[v] < std::numeric_limits<Real>::infinity())) continue;
      const Real by = d[v] + norm(e);
      if (!(by < d[w])) continue;
      d[w] = by;
      if constexpr (kLabels) workspace.vertex_source[w] = workspace.vertex_source[v];
    }
}

}  // namespace plexway
