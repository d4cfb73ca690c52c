#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <random>
#include <vector>

#include <plexway/solid/tet_mesh.hpp>

#include "complexes/test_meshes.hpp"

/// Solids made on the spot, for tests of the core.
namespace plexway::testing {
using namespace detail;

using Tet = std::array<Index, 4>;

struct Solid {
  std::vector<Position> positions;
  std::vector<Tet> tets;

  template <class Real>
  [[nodiscard]] TetMesh<Real> mesh() const {
    return TetMesh<Real>(positions, tets);
  }
  [[nodiscard]] Index nearest(double x, double y, double z) const {
    Index best = 0;
    double least = 1e300;
    for (Index v = 0; v < positions.size(); ++v) {
      const double d = std::hypot(positions[v][0] - x, positions[v][1] - y, positions[v][2] - z);
      if (d < least) least = d, best = v;
    }
    return best;
  }
  [[nodiscard]] std::vector<std::array<double, 6>> lengths() const {
    std::vector<std::array<double, 6>> all;
    for (const Tet& t : tets) {
      all.emplace_back();
      for (std::size_t e = 0; e < 6; ++e) {
        const Position &a = positions[t[tet_edge_ends[e][0]]],
                       &b = positions[t[tet_edge_ends[e][1]]];
        all.back()[e] = std::hypot(b[0] - a[0], b[1] - a[1], b[2] - a[2]);
      }
    }
    return all;
  }
};

/// The six tetrahedra of a cell of a grid (Kuhn), from corner `first` along the axes in any order.
template <class Vertex>
void add_kuhn(Solid& s, const std::array<Index, 3>& first, const Vertex& vertex) {
  std::array<std::size_t, 3> axis = {0, 1, 2};
  do {
    std::array<Index, 3> at = first;
    Tet tet;
    tet[0] = vertex(at[0], at[1], at[2]);
    for (std::size_t n = 0; n < 3; ++n) {
      ++at[axis[n]];
      tet[n + 1] = vertex(at[0], at[1], at[2]);
    }
    s.tets.push_back(tet);
  } while (std::next_permutation(axis.begin(), axis.end()));
}

/// The cubes (i, j, k) of side 1 / n with `has`, six tetrahedra each (Kuhn), inner vertices moved
/// by up to `jitter` cubes.
template <class Has>
Solid cubes(Index nx, Index ny, Index nz, double side, double jitter, Has has) {
  Solid s;
  const auto inside = [&](Index i, Index j, Index k) {
    return i < nx && j < ny && k < nz && has(i, j, k);  // an index before 0 wraps and fails
  };
  std::vector<Index> number((nx + 1) * (ny + 1) * (nz + 1), none);
  const auto vertex = [&](Index i, Index j, Index k) -> Index& {
    return number[(k * (ny + 1) + j) * (nx + 1) + i];
  };
  std::mt19937 random(5);
  for (Index k = 0; k <= nz; ++k)
    for (Index j = 0; j <= ny; ++j)
      for (Index i = 0; i <= nx; ++i) {
        int around = 0;
        for (Index c = 0; c < 8; ++c) around += inside(i - (c & 1), j - (c >> 1 & 1), k - (c >> 2));
        if (around == 0) continue;
        Position p = {double(i), double(j), double(k)};
        for (double& x : p) {
          const double move = (2 * uniform(random) - 1) * jitter;
          x = (x + (around == 8 ? move : 0)) * side;
        }
        vertex(i, j, k) = static_cast<Index>(s.positions.size());
        s.positions.push_back(p);
      }
  for (Index k = 0; k < nz; ++k)
    for (Index j = 0; j < ny; ++j)
      for (Index i = 0; i < nx; ++i) {
        if (!has(i, j, k)) continue;
        add_kuhn(s, {i, j, k}, vertex);
      }
  return s;
}

/// A cube of side 1.
inline Solid solid_cube(Index n, double jitter = 0.15) {
  return cubes(n, n, n, 1.0 / n, jitter, [](Index, Index, Index) { return true; });
}
/// The cube without the quarter x > 1/2, y > 1/2: one reflex edge, at (1/2, 1/2, z). n even.
inline Solid l_shape(Index n, double jitter = 0.15) {
  return cubes(n, n, n, 1.0 / n, jitter,
               [n](Index i, Index j, Index) { return i < n / 2 || j < n / 2; });
}
/// The cube with a wall from 3/8 to 5/8 of x that leaves y > 3/4 open: two reflex edges. n in 8ths.
inline Solid walled(Index n, double jitter = 0.15) {
  return cubes(n, n, n, 1.0 / n, jitter, [n](Index i, Index j, Index) {
    return i < 3 * n / 8 || i >= 5 * n / 8 || j >= 3 * n / 4;
  });
}
/// Two cubes of side 1/2 that touch in the edge (1/2, 1/2, z), z < 1/2.
inline Solid edge_touch(Index n) {
  return cubes(n, n, n / 2, 1.0 / n, 0.1,
               [n](Index i, Index j, Index) { return (i < n / 2) == (j < n / 2); });
}
/// Two cubes of side 1/2 that touch in (1/2, 1/2, 1/2).
inline Solid vertex_touch(Index n) {
  return cubes(n, n, n, 1.0 / n, 0.1, [n](Index i, Index j, Index k) {
    return (i < n / 2) == (j < n / 2) && (j < n / 2) == (k < n / 2);
  });
}

/// A prism of height 1 between regular polygons of radius 1/2 and 1: `sides` reflex edges in a row.
/// Layers of `across` rings, cut as `cubes` are; vertices inside are moved.
inline Solid pipe(Index sides, Index across, Index layers, double jitter = 0.15) {
  Solid s;
  std::mt19937 random(5);
  const auto vertex = [&](Index side, Index ring, Index layer) {
    return (layer * (across + 1) + ring) * sides + side % sides;
  };
  for (Index layer = 0; layer <= layers; ++layer)
    for (Index ring = 0; ring <= across; ++ring)
      for (Index side = 0; side < sides; ++side) {
        const bool inside = ring > 0 && ring < across && layer > 0 && layer < layers;
        const auto moved = [&](Index i) {
          return i + (inside ? (2 * uniform(random) - 1) * jitter : 0);
        };
        const double angle = 2 * std::acos(-1.0) / sides * moved(side);
        const double radius = 0.5 + 0.5 * moved(ring) / across, z = moved(layer) / layers;
        s.positions.push_back({radius * std::cos(angle), radius * std::sin(angle), z});
      }
  for (Index layer = 0; layer < layers; ++layer)
    for (Index ring = 0; ring < across; ++ring)
      for (Index side = 0; side < sides; ++side) {
        add_kuhn(s, {side, ring, layer}, vertex);
      }
  return s;
}

/// Rotated about a skew axis, scaled, moved.
inline Solid moved(Solid s, double scale, const Position& by, double angle = 0.7) {
  const double c = std::cos(angle), n = std::sin(angle), u = 1 / std::sqrt(3.0);
  for (Position& p : s.positions) {
    const Position q = p;
    const double along = u * (q[0] + q[1] + q[2]) * (1 - c);
    for (std::size_t i = 0; i < 3; ++i) {
      const double cross = u * (q[(i + 2) % 3] - q[(i + 1) % 3]);
      p[i] = scale * (c * q[i] + n * cross + u * along) + by[i];
    }
  }
  return s;
}

inline std::vector<double> straight(const Solid& s, const Position& from) {
  std::vector<double> d;
  for (const Position& p : s.positions)
    d.push_back(std::hypot(p[0] - from[0], p[1] - from[1], p[2] - from[2]));
  return d;
}

/// Shortest paths along edges: an upper bound by another way.
inline std::vector<double> along_edges(const Solid& s, Index source) {
  std::vector<double> d(s.positions.size(), std::numeric_limits<double>::infinity());
  d[source] = 0;
  const auto lengths = s.lengths();
  for (bool any = true; any;) {
    any = false;
    for (std::size_t t = 0; t < s.tets.size(); ++t)
      for (std::size_t e = 0; e < 6; ++e) {
        double& a = d[s.tets[t][tet_edge_ends[e][0]]];
        double& b = d[s.tets[t][tet_edge_ends[e][1]]];
        if (a + lengths[t][e] < b) b = a + lengths[t][e], any = true;
        if (b + lengths[t][e] < a) a = b + lengths[t][e], any = true;
      }
  }
  return d;
}

}  // namespace plexway::testing
