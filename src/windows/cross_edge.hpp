#pragma once

#include <cstddef>
#include <limits>
#include <span>

#include <plexway/surface/detail/triangle_record.hpp>

namespace plexway::detail::windows {
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

/// Up to where on an edge its first vertex serves as well as a source at (x, -h) from that vertex:
/// x0 = 0, the vertex `c` farther away than the source's own sigma. Parallel light as a beam has
/// it. +inf where the vertex serves all of the edge; anything below 0, or NaN, where it serves
/// none.
///
/// From c + b <= |S - b|, squared: no root is taken. (Solving for b where |S - b| - b, which falls
/// with b, comes down to c.)
template <class Real>
[[gnu::always_inline]] inline Real served_from_end(Real x, Real h, Real c) {
  if (h < 0) [[unlikely]]  // parallel light, that much nearer than the vertex at the edge's start
    return -c / (1 - x);
  const Real sum = c + x, gain = x * x + h * h - c * c;
  if (!(sum > 0) || (c < 0 && gain < 0)) return std::numeric_limits<Real>::infinity();
  return gain / (2 * sum);
}

}  // namespace plexway::detail::windows
