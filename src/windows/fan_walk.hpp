#pragma once

#include <span>

#include <plexway/surface/detail/triangle_record.hpp>

namespace plexway::windows {

/// A corner of a triangle on a walk around its vertex: entered by one of the two edges that meet
/// there, left by the other. Sheets that turn over are walked like any other.
struct FanWalk {
  Index face;
  Index corner;
  bool by_start;  ///< leaves over edge `corner`, which starts here, not over the one before

  [[nodiscard]] Index leaving_edge() const {
    return by_start ? corner : static_cast<Index>(edge_before(corner));
  }
  [[nodiscard]] Index entering_edge() const {
    return by_start ? static_cast<Index>(edge_before(corner)) : corner;
  }

  /// To the next corner around the vertex. False, and nothing done, where the fan ends: at a
  /// boundary, or at an edge with more than two triangles.
  template <class Real>
  bool step(std::span<const TriangleRecord<Real>> triangles) {
    const Index across = triangles[face].across[leaving_edge()];
    const Index g = across >> Across::face_shift, j = across & Across::edge_mask;
    if (g + 1 == triangles.size() || (across & Across::fan)) return false;
    // Opposite directions: the start of one side is the end of the other.
    const bool at_start = by_start == ((across & Across::flip) != 0);
    face = g;
    corner = at_start ? j : static_cast<Index>(edge_after(j));
    by_start = !at_start;
    return true;
  }
};

}  // namespace plexway::windows
