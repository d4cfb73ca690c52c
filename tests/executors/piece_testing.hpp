#pragma once

#include <cstddef>
#include <vector>

#include <plexway/executors.hpp>

#include "complexes/test_meshes.hpp"

namespace plexway::testing {

/// By pieces so small that there are many even here.
inline OpenMP pieces(int threads, std::size_t size) { return {.threads = threads, .piece = size}; }

/// Surfaces of every kind: open, closed, one-sided, of several sheets, torn.
inline std::vector<Surface> surfaces() {
  std::vector<Surface> all = {grid(24, 24),
                              grid(40, 12, 3, 1),
                              slit_square(12),
                              cube(8),
                              sphere(4),
                              prism(24, 12, 2),
                              moebius(60, 8),
                              sheets(3, 8),
                              bow_tie(10),
                              soup(60, 120, 1),
                              soup(80, 60, 2),
                              tetrahedron(),
                              subdivide(tetrahedron())};
  for (unsigned seed = 1; seed <= 4; ++seed) all.push_back(random_polygon(6, 120, 120, seed));
  return all;
}

/// A square whose left half is slower: lengths jump, paths are refracted.
template <class Real>
TriangleMesh<Real> two_speeds(Index n) {
  const Surface s = grid(n, n);
  auto lengths = lengths_of(s);
  for (std::size_t f = 0; f < s.faces.size(); ++f) {
    double x = 0;
    for (const Index v : s.faces[f]) x += s.positions[v][0] / 3;
    for (double& length : lengths[f]) length *= x < 0.5 ? 1.7 : 1;
  }
  SurfaceHints hints;
  hints.refracts = true;
  return {s.positions.size(), s.faces, lengths, hints};
}

}  // namespace plexway::testing
