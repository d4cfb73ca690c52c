#pragma once

#include <span>
#include <vector>

#include <plexway/surface/triangle_mesh.hpp>

#include "labels/curve_pieces.hpp"
#include "windows/window_sources.hpp"

namespace plexway::windows {

/// What windows from curves and triangles start with. Light of a straight piece is parallel within
/// the strip over it, to both sides; strips of pieces that go straight on lie beside each other.
/// Ends and bends are points.
struct CurveLights {
  std::vector<LineLight> lights;
  std::vector<CornerBesideLine> corners;

  /// A curve as propagation number `number`; its offset in the caller's unit.
  template <class Real>
  void add_curve(const TriangleMesh<Real>& mesh, std::span<const CurvePiece> pieces, double offset,
                 Index number);
  /// All of one triangle, by its caller's number: out over its edges.
  template <class Real>
  void add_face(const TriangleMesh<Real>& mesh, Index face, double offset, Index number);
};

}  // namespace plexway::windows
