#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <span>
#include <utility>
#include <vector>

#include <plexway/surface/triangle_mesh.hpp>

#include "complexes/partition/cut.hpp"
#include "windows/vertex_angles.hpp"
#include "windows/window_sources.hpp"

namespace plexway::detail::windows {
/// What windows run over: a surface, or a piece of one by numbers of its own. Of a piece the
/// triangles around its vertices that are other pieces' (ghosts) are there to be gone around; a
/// window that enters one leaves the piece.
template <class Real>
struct Sheet {
  const TriangleMesh<Real>* mesh = nullptr;
  const VertexAngles* angles = nullptr;             ///< of its own vertices
  std::span<const TriangleRecord<Real>> triangles;  ///< its own, ghosts, a sentinel
  Index own = 0;                                    ///< triangles
  Index vertex_count = 0;
  Index shared = 0;  ///< so many vertices, the first, are other pieces', too
  // Of a piece:
  const Cut* cut = nullptr;
  Index piece = 0;
  std::span<const Index> vertices;  ///< the surface's numbers

  [[nodiscard]] static Sheet whole(const TriangleMesh<Real>& mesh, const VertexAngles& angles) {
    return {.mesh = &mesh,
            .angles = &angles,
            .triangles = mesh.triangles(),
            .own = static_cast<Index>(mesh.face_count()),
            .vertex_count = static_cast<Index>(mesh.vertex_count()),
            .vertices = {}};
  }

  [[nodiscard]] Index sentinel() const { return static_cast<Index>(triangles.size() - 1); }

  /// The corners of its own triangles at a vertex.
  void corners_at(Index vertex, std::vector<Index>& corners) const {
    if (cut == nullptr) {
      mesh->corners_at(vertex, corners);
      return;
    }
    mesh->corners_at(vertices[vertex], corners);
    std::size_t count = 0;
    for (const Index c : corners)
      if (cut->piece_of[c / 3] == piece) corners[count++] = 3 * cut->number_of[c / 3] + c % 3;
    corners.resize(count);
  }
};

/// The source inside triangle t as its edge e sees it.
template <class Real>
struct SeenFromEdge {
  double x, h, length;
  SeenFromEdge(const TriangleRecord<Real>& t, const std::array<double, 4>& b, std::size_t e)
      : x(b[edge_after(e)] * static_cast<double>(t.length[e]) +
          b[edge_before(e)] * static_cast<double>(t.apex_x(e))),
        h(b[edge_before(e)] * static_cast<double>(t.apex_h(e))),
        length(static_cast<double>(t.length[e])) {}
};

/// So small a barycentric coordinate is none: the point lies on that edge. With two it lies at a
/// corner, since its light over the edges there would be lost in rounding.
template <class Real>
inline constexpr double on_edge = sizeof(Real) == sizeof(float) ? 3e-5 : 1e-9;

/// Calls at_vertex(v, offset, n) or inside(f, barycentric, offset, n) for each of the points, by
/// the surface's numbers and in its unit. The offset of a vertex that the point only all but lies
/// at is longer by the way there, so that nothing comes out nearer than it is.
template <class Real, class AtVertex, class Inside>
void for_each_seed(const TriangleMesh<Real>& mesh, const WindowSources& sources,
                   const AtVertex& at_vertex, const Inside& inside) {
  for (std::size_t n = 0; n < sources.points.size(); ++n) {
    const PointSource& s = sources.points[n];
    const Index number = sources.number(n);
    const double offset = s.offset / mesh.unit();
    if (s.vertex != none) {
      at_vertex(mesh.inside_vertex(s.vertex), offset, number);
      continue;
    }
    const auto [f, turned] = mesh.inside_face(s.simplex);
    std::array<double, 4> b = s.barycentric;
    if (turned) std::swap(b[1], b[2]);
    const TriangleRecord<Real>& t = mesh.triangles()[f];
    const auto k = static_cast<std::size_t>(std::max_element(b.begin(), b.begin() + 3) - b.begin());
    if (std::max(b[edge_after(k)], b[edge_before(k)]) <= on_edge<Real>) {
      const SeenFromEdge<Real> seen(t, b, k);
      at_vertex(t.corner[k], offset + std::sqrt(seen.x * seen.x + seen.h * seen.h), number);
    } else {
      inside(f, b, offset, number);
    }
  }
}

}  // namespace plexway::detail::windows
