#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <span>
#include <utility>

#include <plexway/solid/tet_mesh.hpp>
#include <plexway/source/point_source.hpp>

#include "labels/changed_vertices.hpp"
#include "labels/workspace_state.hpp"

namespace plexway {

/// No vertex has a distance.
template <bool kLabels, class Real>
void start_read_out(std::size_t vertices, WorkspaceState<Real>& workspace) {
  workspace.vertex.assign(vertices, std::numeric_limits<Real>::infinity());
  if constexpr (kLabels) workspace.vertex_source.assign(vertices, none);
}

/// Every corner of every reached tetrahedron offers a distance; vertices keep the least. Before,
/// they are at infinity.
template <class Real, bool kLabels, class Rule, class Front>
void read_out_tets(const TetMesh<Real>& mesh, const Rule& rule, const Front& front,
                   WorkspaceState<Real>& workspace) {
  const std::span<const TetRecord<Real>> tets = mesh.tets();
  for (Index t = 0; t + 1 < tets.size(); ++t) {
    if (!front.reached(t)) continue;
    for (Index i = 0; i < 4; ++i) {
      const Index v = tets[t].corner[i];
      const Real d = rule.corner_distance(t, i, workspace.vertex[v]);
      if (!(d < workspace.vertex[v])) continue;
      workspace.vertex[v] = d;
      if constexpr (kLabels) workspace.vertex_source[v] = front.source(t);
    }
  }
}

/// Calls offer(vertex, distance) for a source at a vertex, or for the corners of the tetrahedron it
/// lies in: inside numbers and unit, exact.
template <class Real, class Offer>
void offer_corners(const TetMesh<Real>& mesh, const PointSource& source, const Offer& offer) {
  const double sigma = source.offset / mesh.unit();
  if (source.vertex != none) {
    offer(mesh.inside_vertex(source.vertex), sigma);
    return;
  }
  const auto [t, turned] = mesh.inside_tet(source.simplex);
  std::array<double, 4> b = source.barycentric;
  if (turned) std::swap(b[2], b[3]);
  const auto& corner = mesh.tets()[t].corner;
  // |p v_i|^2 = sum_j b_j l_ij^2 - sum_(j<k) b_j b_k l_jk^2.
  std::array<double, 4> toward{};
  double within = 0;
  for (std::size_t e = 0; e < 6; ++e) {
    const std::size_t i = tet_edge_ends[e][0], j = tet_edge_ends[e][1];
    double length2 = 0;
    if (mesh.embedded()) {
      const auto along = mesh.points()[corner[j]] - mesh.points()[corner[i]];
      length2 = static_cast<double>(dot(along, along));
    } else {
      length2 = static_cast<double>(mesh.squared_lengths()[t][e]);
    }
    toward[i] += b[j] * length2;
    toward[j] += b[i] * length2;
    within += b[i] * b[j] * length2;
  }
  for (std::size_t i = 0; i < 4; ++i)
    offer(corner[i], b[i] == 1 ? sigma : sigma + std::sqrt(std::max(toward[i] - within, 0.)));
}

/// The same for the vertices from `begin` to `end`, each from its own tetrahedra: what several
/// threads can do at once, and where paths bend, less work.
template <class Real, bool kLabels, class Rule, class Front>
void read_out_around(const TetMesh<Real>& mesh, const Rule& rule, const Front& front, Index begin,
                     Index end, WorkspaceState<Real>& workspace) {
  for (Index v = begin; v < end; ++v) {
    rule.ask_around(mesh.corners_at(v), [&](Index t, Real distance) {
      workspace.vertex[v] = distance;
      if constexpr (kLabels) workspace.vertex_source[v] = front.source(t);
    });
  }
}

/// For one thread, all vertices.
template <class Real, bool kLabels, class Rule, class Front>
void read_out(const TetMesh<Real>& mesh, const Rule& rule, const Front& front,
              WorkspaceState<Real>& workspace) {
  const std::size_t vertices = mesh.vertex_count();
  start_read_out<kLabels>(vertices, workspace);
  if (rule.bends())
    read_out_around<Real, kLabels>(mesh, rule, front, 0, static_cast<Index>(vertices), workspace);
  else
    read_out_tets<Real, kLabels>(mesh, rule, front, workspace);
}

/// No vertex is farther than a neighbour and the edge between. True if some vertex got nearer.
/// Cost: one pass, and the surroundings of what it changed.
///
/// search(wrong, look) calls look(t) at least for all tetrahedra that wrong(t) names.
template <class Real, bool kLabels, class Search>
bool read_out_tet_edges(const TetMesh<Real>& mesh, WorkspaceState<Real>& workspace,
                        const Search& search) {
  const std::span<const TetRecord<Real>> tets = mesh.tets();
  const std::span<const Vector3<Real>> points = mesh.points();
  const std::span<const std::array<Real, 6>> lengths = mesh.squared_lengths();
  const bool embedded = mesh.embedded();
  Real* d = workspace.vertex.data();
  ChangedVertices changed(workspace.front);
  const auto squared_length = [&](std::size_t t, Index i, Index j) {
    const Vector3<Real> e =
        embedded ? points[tets[t].corner[j]] - points[tets[t].corner[i]] : Vector3<Real>{};
    return embedded ? dot(e, e) : lengths[t][tet_edge(i, j)];
  };
  const auto wrong = [&](std::size_t t) {
    for (const auto& ends : tet_edge_ends) {
      const Real rise = d[tets[t].corner[ends[1]]] - d[tets[t].corner[ends[0]]];
      if (!(rise * rise <= squared_length(t, ends[0], ends[1]))) return true;
    }
    return false;
  };
  const auto relax = [&](std::size_t t, Index i, Index j) {
    // Most need no change, and whichever end is nearer: that cannot be predicted.
    Index v = tets[t].corner[i], w = tets[t].corner[j];
    const Real length2 = squared_length(t, i, j);
    const Real rise = d[w] - d[v];
    if (rise * rise <= length2) [[likely]]
      return;
    if (d[w] < d[v]) std::swap(v, w);
    if (!(d[w] < std::numeric_limits<Real>::infinity())) return;
    const Real by = d[v] + std::sqrt(length2);
    if (!(by < d[w])) return;
    d[w] = by;
    if constexpr (kLabels) workspace.vertex_source[w] = workspace.vertex_source[v];
    changed.push(w);
  };
  bool any = false;
  do {
    changed.clear();
    search(wrong, [&](std::size_t t) {
      for (const auto& ends : tet_edge_ends) relax(t, ends[0], ends[1]);
    });
    any |= changed.some();
    for (Index v = 0; changed.pop(v);)
      for (const Index corner : mesh.corners_at(v))
        for (Index j = 0; j < 4; ++j)
          if (j != corner % 4) relax(corner / 4, corner % 4, j);
  } while (changed.lost());
  return any;
}

template <class Real, bool kLabels>
bool read_out_tet_edges(const TetMesh<Real>& mesh, WorkspaceState<Real>& workspace) {
  return read_out_tet_edges<Real, kLabels>(mesh, workspace, [&](const auto&, const auto& look) {
    for (std::size_t t = 0; t < mesh.tet_count(); ++t) look(t);
  });
}

}  // namespace plexway
