#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include <plexway/surface/triangle_mesh.hpp>

#include "complexes/common/geometry.hpp"
#include "paths/surface_shape.hpp"

namespace plexway::detail {

/// From one triangle to the next: out over edge `from` of the one, into `face` over its `edge`.
/// flip: both edges run the same way.
struct Crossing {
  Index face;
  std::uint8_t from, edge;
  bool flip;
};

/// A row of triangles from one point to another: all that is known of a way before it is pulled
/// straight. The points have barycentric coordinates in the first and the last triangle.
struct Strip {
  Index first = none;
  std::array<double, 3> start = {}, end = {};
  std::vector<Crossing> crossings;

  /// The triangle before crossing i; with as many as there are crossings, the last.
  [[nodiscard]] Index face(std::size_t i) const { return i == 0 ? first : crossings[i - 1].face; }
  [[nodiscard]] Index last() const { return face(crossings.size()); }
};

/// The corner at which a point lies, or 3.
inline std::size_t corner_of(const std::array<double, 3>& b) {
  for (std::size_t i = 0; i < 3; ++i)
    if (b[i] == 1) return i;
  return 3;
}
inline std::array<double, 3> at_corner(std::size_t i) {
  std::array<double, 3> b = {};
  b[i] = 1;
  return b;
}

/// The corner of `c.face` that corner i of the triangle before is, or 3 if it is none of the edge.
inline std::size_t carried(const Crossing& c, std::size_t i) {
  if (i == c.from) return c.flip ? c.edge : edge_after(c.edge);
  if (i == edge_after(c.from)) return c.flip ? edge_after(c.edge) : c.edge;
  return 3;
}
/// The other way.
inline Crossing reverse(const Crossing& c, Index before) {
  return {before, c.edge, c.from, c.flip};
}

/// Calls visit(crossing) for every triangle across an edge.
template <class Real, class Visit>
void across_edge(const TriangleMesh<Real>& mesh, Index f, std::size_t edge, Visit visit) {
  const auto triangles = mesh.triangles();
  const Index sentinel = static_cast<Index>(mesh.face_count());
  Index across = triangles[f].across[edge];
  bool flip = (across & Across::flip) != 0;
  for (;;) {
    const Index g = across >> Across::face_shift;
    const Index k = across & Across::edge_mask;
    if (g == sentinel || (g == f && k == edge)) return;
    visit(Crossing{g, static_cast<std::uint8_t>(edge), static_cast<std::uint8_t>(k), flip});
    if (!(across & Across::fan)) return;
    across = triangles[g].across[k];
    flip = flip == ((across & Across::flip) != 0);
  }
}

/// Where a pulled strip turns around a vertex: one of the ends of the crossings [begin, end).
struct Bend {
  std::size_t begin, end;
  bool left;
  Vector2 at;
};

/// The shortest way within a strip.
struct PulledStrip {
  double length = 0;          ///< in the plane
  std::vector<Bend> bends;    ///< those of one edge overlap by nothing: each crossing has one bend
  std::vector<double> along;  ///< where it passes each crossing's `edge`, 0 to 1
};

/// Leaves out what a strip need not visit: triangles around a vertex it starts or ends at,
/// crossings of an edge that it starts or ends on, and ways in and out over one edge.
void trim(Strip& strip);

/// Unfolds the strip into the plane and pulls the way tight, as Lee and Preparata do (Euclidean
/// shortest paths in the presence of rectilinear barriers, 1984). Cost: linear.
template <class Real>
PulledStrip pull(const SurfaceShape<Real>& shape, const Strip& strip);

/// Where the way through a pulled strip enters triangle i, or its start.
std::array<double, 3> entry(const Strip& strip, const PulledStrip& pulled, std::size_t i);
/// Where it leaves triangle i, in the coordinates of that one, or its end.
std::array<double, 3> exit(const Strip& strip, const PulledStrip& pulled, std::size_t i);

/// Makes strips locally shortest.
///
/// A pulled strip touches vertices. Where there is less than pi of surface on the other side of
/// such a vertex, the strip moves over to that side, and is pulled again (the idea of Sharp and
/// Crane, You Can Find Geodesic Paths in Triangle Meshes by Just Flipping Edges, 2020, on a row of
/// triangles instead of a triangulation). The way through the vertex lies in the new strip too and
/// is not shortest there, so each move makes the path shorter, and as there are only so many strips
/// shorter than a given length, it ends; moves that rounding keeps from shortening are taken back.
template <class Real>
class Straightener {
 public:
  Straightener(const TriangleMesh<Real>& mesh, const SurfaceShape<Real>& shape)
      : mesh_(&mesh), shape_(&shape) {}

  /// Changes the strip to that of a locally shortest path, which is returned.
  PulledStrip straighten(Strip& strip) const;

  /// The triangles around the vertex at corner `in` of triangle f, from a direction there to one
  /// at corner `out` of triangle g, the shorter way around: `in_angle` and `out_angle` are measured
  /// from the edges of these numbers. False if no way around leads there; with `most`, also if it
  /// is longer than that.
  bool around(Index f, std::size_t in, double in_angle, Index g, std::size_t out, double out_angle,
              double most, std::vector<Crossing>& way) const;

 private:
  bool move(const Strip& strip, const PulledStrip& pulled, const Bend& bend,
            std::vector<Crossing>& way) const;

  const TriangleMesh<Real>* mesh_;
  const SurfaceShape<Real>* shape_;
};

}  // namespace plexway::detail
