#pragma once

#include <cstddef>
#include <span>

#include <plexway/surface/detail/triangle_record.hpp>

namespace plexway::windows {

/// The halfedge that an Across leads to, 4 f + i.
[[nodiscard]] constexpr Index halfedge_of(Index across) {
  return across >> Across::face_shift << 2 | (across & Across::edge_mask);
}

/// All triangles on the other side of edge `edge` of f, one or several: calls
/// over(across, turned). `across` leads to the triangle's own edge; `turned` says that this runs
/// the same way as the edge left, so that what was measured from the one's second corner, which is
/// otherwise the other's first, must be mirrored. The edge is no boundary.
template <class Real, class Over>
void cross_edge(std::span<const TriangleRecord<Real>> triangles, Index f, std::size_t edge,
                const Over& over) {
  Index across = triangles[f].across[edge];
  bool turned = (across & Across::flip) != 0;
  if (!(across & Across::fan)) {
    over(across, turned);
    return;
  }
  // All the way around the edge; each turn is told from the one before.
  for (;;) {
    const Index g = across >> Across::face_shift, k = across & Across::edge_mask;
    if (g == f && k == edge) return;
    over(across, turned);
    across = triangles[g].across[k];
    turned ^= !(across & Across::flip);
  }
}

}  // namespace plexway::windows
