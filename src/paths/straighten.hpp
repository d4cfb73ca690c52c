#pragma once

#include <vector>

#include <plexway/surface/triangle_mesh.hpp>

#include "paths/strip.hpp"
#include "paths/surface_shape.hpp"

namespace plexway::detail {

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
