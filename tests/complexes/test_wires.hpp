#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

#include <plexway/wireframe/wireframe.hpp>

#include "complexes/test_meshes.hpp"

/// Wireframes made on the spot, for tests.
namespace plexway::testing {

struct Wires {
  std::size_t vertices = 0;
  std::vector<std::array<Index, 2>> edges;
  std::vector<double> lengths;

  void add(Index a, Index b, double length) {
    edges.push_back({a, b});
    lengths.push_back(length);
  }
  template <class Real>
  [[nodiscard]] Wireframe<Real> wireframe() const {
    return Wireframe<Real>(vertices, edges, lengths);
  }
};

/// Any edges between any vertices: several components, lone vertices, parallel edges, loops and
/// edges without length come along. `spread` is the power of ten that lengths vary by, up and down.
inline Wires random_wires(unsigned seed, std::size_t vertices, std::size_t edges,
                          double spread = 0.5) {
  std::mt19937 random(seed);
  Wires w{vertices, {}, {}};
  for (std::size_t e = 0; e < edges; ++e) {
    const Index a = below(random, vertices);
    const Index b = e % 11 == 3 ? a : below(random, vertices);
    const double length = e % 7 == 5 ? 0 : std::pow(10, spread * (2 * uniform(random) - 1));
    w.add(a, b, length);
    if (e % 5 == 1) w.add(b, a, length * (0.5 + uniform(random)));
  }
  return w;
}

/// Distances in double from a distance to begin with a vertex (+inf: none), by going over all edges
/// until nothing changes.
inline std::vector<double> edge_distances(const Wires& w, std::vector<double> distance) {
  for (bool any = true; any;) {
    any = false;
    for (std::size_t e = 0; e < w.edges.size(); ++e) {
      double &a = distance[w.edges[e][0]], &b = distance[w.edges[e][1]];
      const double l = w.lengths[e];
      if (a + l < b) b = a + l, any = true;
      if (b + l < a) a = b + l, any = true;
    }
  }
  return distance;
}
inline std::vector<double> edge_distances(const Wires& w, Index source) {
  std::vector<double> start(w.vertices, std::numeric_limits<double>::infinity());
  start[source] = 0;
  return edge_distances(w, start);
}

}  // namespace plexway::testing
