#pragma once

#include <cstddef>
#include <random>

#include "complexes/test_meshes.hpp"

namespace plexway::testing {

/// The unit square, its vertices inside moved at random: no two edges are parallel, and none of
/// the triangles turns over.
inline Surface jittered(Index n, unsigned seed) {
  Surface s = grid(n, n);
  std::mt19937 random(seed);
  for (Position& p : s.positions)
    for (std::size_t i = 0; i < 2; ++i)
      if (p[0] > 0 && p[0] < 1 && p[1] > 0 && p[1] < 1)
        p[i] += (uniform(random) - .5) / (2 * static_cast<double>(n));
  return s;
}

}  // namespace plexway::testing
