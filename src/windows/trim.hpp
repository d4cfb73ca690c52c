#pragma once

#include <limits>

namespace plexway::windows {

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

}  // namespace plexway::windows
