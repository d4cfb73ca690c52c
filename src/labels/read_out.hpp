#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <utility>

#include <plexway/source/point_source.hpp>
#include <plexway/surface/triangle_mesh.hpp>

#include "labels/front.hpp"
#include "labels/surface/saddle_rule.hpp"
#include "labels/workspace_state.hpp"

namespace plexway::detail {

/// Calls offer(vertex, distance) for a source at a vertex, or for the corners of the triangle it
/// lies in: inside numbers and unit, exact.
template <class Real, class Offer>
void offer_source(const TriangleMesh<Real>& mesh, const PointSource& source, const Offer& offer) {
  const double sigma = source.offset / mesh.unit();
  if (source.vertex != none) {
    offer(mesh.inside_vertex(source.vertex), sigma);
    return;
  }
  const auto [f, turned] = mesh.inside_face(source.simplex);
  const TriangleRecord<Real>& t = mesh.triangles()[f];
  std::array<double, 4> b = source.barycentric;
  if (turned) std::swap(b[1], b[2]);
  const double px[3] = {0, static_cast<double>(t.length[0]), static_cast<double>(t.apex_x(0))};
  const double py[3] = {0, 0, static_cast<double>(t.apex_h(0))};
  const double x = b[1] * px[1] + b[2] * px[2], y = b[2] * py[2];
  for (std::size_t i = 0; i < 3; ++i)
    offer(t.corner[i], b[i] == 1 ? sigma : sigma + std::hypot(px[i] - x, py[i] - y));
}

/// Distances of the corners of two triangles from the edges their paths came in
/// by: path_length of saddle_step.hpp for the apexes, and the same for the ends
/// of the edges. Lanes 0 1 are the two sides of one triangle and lanes 2 3
/// those of the other.
template <class Real>
struct CornerDistances {
  using L = kernel::Lanes<Real>;
  using Mask = typename L::Mask;
  Real distance[2];
  L ends;  ///< first and second end of one, first and second of the other

  /// `sides` leads from each lane's end of the edge to the apex.
  [[gnu::always_inline]] CornerDistances(const SaddleLabel<Real>& a, const SaddleLabel<Real>& b,
                                         const Real length[2], const Real apex_x[2],
                                         const Real apex_h[2], const L& sides) {
    const L mirror(1, -1, 1, -1), off(0, length[0], 0, length[1]);
    const auto pair = [](typename L::Vector u, typename L::Vector w, auto i, auto j) {
      return L(u[i], u[j], w[i], w[j]);
    };
    const auto ax = a.x.v, ah = a.h.v, bx = b.x.v, bh = b.h.v;
    const L Sx = off + mirror * pair(ax, bx, 0, 0), Sh = pair(ah, bh, 0, 0);
    const L px = mirror * pair(ax, bx, 2, 3), ph = pair(ah, bh, 2, 3), py = -ph;
    const L qx(apex_x[0], length[0] - apex_x[0], apex_x[1], length[1] - apex_x[1]);
    const L qh(apex_h[0], apex_h[0], apex_h[1], apex_h[1]);
    const Mask loose = px * Sh + py * Sx > L(0);
    const L ex = select(loose, px, -Sx), ey = select(loose, py, Sh);
    const L gx = qx - Sx, gy = qh + Sh;
    const Mask dark = ex * gy - ey * gx > L(0);
    const L rx = gx - ex, ry = gy - ey;
    const L tx = Sx + px, th = Sh + ph;  // the limit
    const L near = sqrt(ex * ex + ey * ey), far = sqrt(tx * tx + th * th);
    const L by_limit = near + select(loose, far, L(0));  // to the hinge's end
    const Mask misses = tx * qh + qx * th < L(0);        // from the limit past the hinge's end
    const L bent = select(misses & loose, by_limit + sides, near + sqrt(rx * rx + ry * ry));
    const L d = select(dark, bent, sqrt(gx * gx + gy * gy));
    distance[0] = std::max(d[0], d[1]) + a.sigma();
    distance[1] = std::max(d[2], d[3]) + b.sigma();
    ends = by_limit + L(a.sigma(), a.sigma(), b.sigma(), b.sigma());
  }
};

/// Every reached triangle from `begin` to `end` offers its corners distances:
/// offer(vertex, distance, triangle).
template <class Real, class Rule, class Front, class Offer>
[[gnu::always_inline]] inline void offer_apexes(std::span<const TriangleRecord<Real>> triangles,
                                                const Rule& rule, const Front& front, Index begin,
                                                Index end, const Offer& offer) {
  const auto one = [&](Index f) {
    for (std::size_t i = 0; i < 3; ++i)
      offer(triangles[f].corner[i], rule.corner_distance(f, i), f);
  };
  constexpr std::size_t before[3] = {2, 0, 1}, after[3] = {1, 2, 0};
  Index f = begin;
  for (; f + 1 < end; f += 2) {
    if (!front.reached(f) || !front.reached(f + 1)) {
      for (const Index g : {f, f + 1})
        if (front.reached(g)) one(g);
      continue;
    }
    const std::size_t in[2] = {front.hinge(f), front.hinge(f + 1)};
    const TriangleRecord<Real>&s = triangles[f], &t = triangles[f + 1];
    const Real length[2] = {s.length[in[0]], t.length[in[1]]};
    const Real x[2] = {s.apex_x(in[0]), t.apex_x(in[1])};
    const Real h[2] = {s.apex_h(in[0]), t.apex_h(in[1])};
    const kernel::Lanes<Real> sides(s.length[before[in[0]]], s.length[after[in[0]]],
                                    t.length[before[in[1]]], t.length[after[in[1]]]);
    const CornerDistances<Real> found(rule.label(f), rule.label(f + 1), length, x, h, sides);
    offer(s.corner[before[in[0]]], found.distance[0], f);
    offer(t.corner[before[in[1]]], found.distance[1], f + 1);
    offer(s.corner[in[0]], found.ends[0], f);
    offer(s.corner[after[in[0]]], found.ends[1], f);
    offer(t.corner[in[1]], found.ends[2], f + 1);
    offer(t.corner[after[in[1]]], found.ends[3], f + 1);
  }
  if (f < end && front.reached(f)) one(f);
}

/// The same for any rule, corner by corner.
template <class Real, class Rule, class Front, class Offer>
void offer_corners(std::span<const TriangleRecord<Real>> triangles, const Rule& rule,
                   const Front& front, Index begin, Index end, const Offer& offer) {
  for (Index f = begin; f < end; ++f)
    if (front.reached(f))
      for (std::size_t i = 0; i < 3; ++i)
        offer(triangles[f].corner[i], rule.corner_distance(f, i), f);
}

/// Vertices keep the least distance that triangles offer.
template <class Real, bool kLabels, class Rule, class Front>
void read_out_triangles(std::span<const TriangleRecord<Real>> triangles, const Rule& rule,
                        const Front& front, WorkspaceState<Real>& workspace) {
  const auto offer = [&](Index v, Real d, Index f) {
    if constexpr (kLabels) {
      if (d < workspace.vertex[v])
        workspace.vertex[v] = d, workspace.vertex_source[v] = front.source(f);
    } else {
      workspace.vertex[v] = std::min(workspace.vertex[v], d);
    }
  };
  const Index faces = static_cast<Index>(triangles.size() - 1);
  if constexpr (requires { rule.label(0).x; })
    offer_apexes(triangles, rule, front, 0, faces, offer);
  else
    offer_corners(triangles, rule, front, 0, faces, offer);
}

/// A vertex that no triangle offered a distance takes the best path to one of
/// its corners.
template <class Real, bool kLabels, class Rule, class Front>
void read_out_around(const TriangleMesh<Real>& mesh, const Rule& rule, const Front& front,
                     Index vertex, WorkspaceState<Real>& workspace) {
  mesh.corners_at(vertex, workspace.corners);
  for (const Index c : workspace.corners) {
    if (!front.reached(c / 3)) continue;
    const Real d = rule.corner_distance(c / 3, c % 3);
    if (!(d < workspace.vertex[vertex])) continue;
    workspace.vertex[vertex] = d;
    if constexpr (kLabels) workspace.vertex_source[vertex] = front.source(c / 3);
  }
}

}  // namespace plexway::detail
