#pragma once

#include <cmath>
#include <random>

#include "complexes/test_meshes.hpp"

/// Surfaces that no solver was drawn for. Each is given to check(surface, source).
namespace plexway::testing {

/// Triangles between any three of up to `most` points more than six.
template <class Check>
void each_soup(unsigned seeds, Index most, const Check& check) {
  for (unsigned seed = 1; seed <= seeds; ++seed) {
    std::mt19937 random(seed);
    const Index points = 6 + below(random, most);
    const Surface s = soup(points, 2 + below(random, 3 * points), seed);
    check(s, below(random, points));
    check(s, s.faces[0][0]);
  }
}

/// Grids of n by n cells and spheres: manifold, with angles from next to nothing to far beyond a
/// full turn, and folded over.
template <class Check>
void each_crumpled(unsigned seeds, Index n, const Check& check) {
  for (unsigned seed = 1; seed <= seeds; ++seed) {
    std::mt19937 random(seed);
    Surface s = grid(n, n);
    for (Position& p : s.positions)
      for (double& c : p) c = uniform(random) * (seed % 2 ? 1 : std::pow(10, 6 * uniform(random)));
    check(s, below(random, s.positions.size()));
    Surface closed = sphere(2);
    for (Position& p : closed.positions)
      for (double& c : p) c *= std::pow(10, 3 * uniform(random));
    check(closed, below(random, closed.positions.size()));
  }
}

/// With triangles that have no area, and edges that have no length.
template <class Check>
void each_flat(const Check& check) {
  std::mt19937 random(4);
  for (int kind = 0; kind < 5; ++kind) {
    Surface s = grid(8, 8);
    for (Position& p : s.positions) {
      if (kind == 0) p[1] = 0;                                 // all on a line
      if (kind == 1) p = {0, 0, 0};                            // all in a point
      if (kind == 2 && uniform(random) < .4) p = {.5, .5, 0};  // many in one
      if (kind == 3) p[0] = std::round(3 * p[0]) / 3;          // rows of slivers
      if (kind == 4) p[1] = p[1] < .5 ? 0 : p[1];
    }
    check(s, 0);
    check(s, 40);
  }
}

}  // namespace plexway::testing
