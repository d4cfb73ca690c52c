#pragma once

#include <array>
#include <catch2/catch.hpp>
#include <cmath>
#include <functional>
#include <limits>
#include <random>
#include <vector>

#include <plexway/solve.hpp>

/// Pieces of mixed domains, and domains made of them whose distances are known.
namespace mixed_domains {

using namespace plexway;
using Position = std::array<double, 3>;
constexpr double infinity = std::numeric_limits<double>::infinity();

inline double distance(const Position& a, const Position& b) {
  return std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]);
}

struct Block {
  std::vector<Position> positions;
  std::vector<std::array<Index, 4>> tets;
};

/// The box from `low` to `high` in n cells a side, each cut into six tetrahedra about a diagonal.
inline Block block(const Position& low, const Position& high, std::size_t n) {
  Block b;
  const std::size_t m = n + 1;
  for (std::size_t i = 0; i < m; ++i)
    for (std::size_t j = 0; j < m; ++j)
      for (std::size_t k = 0; k < m; ++k) {
        const auto at = [&](std::size_t axis, std::size_t step) {
          return low[axis] + (high[axis] - low[axis]) * double(step) / double(n);
        };
        b.positions.push_back({at(0, i), at(1, j), at(2, k)});
      }
  const std::size_t stride[3] = {m * m, m, 1};
  constexpr int orders[6][3] = {{0, 1, 2}, {0, 2, 1}, {1, 0, 2}, {1, 2, 0}, {2, 0, 1}, {2, 1, 0}};
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t j = 0; j < n; ++j)
      for (std::size_t k = 0; k < n; ++k)
        for (const auto& order : orders) {
          std::size_t v = i * stride[0] + j * stride[1] + k;
          std::array<Index, 4> tet = {Index(v), 0, 0, 0};
          for (std::size_t c = 0; c < 3; ++c) tet[c + 1] = Index(v += stride[order[c]]);
          b.tets.push_back(tet);
        }
  return b;
}

struct Sheet {
  std::vector<Position> positions;
  std::vector<std::array<Index, 3>> faces;
};

/// The parallelogram at `origin` spanned by u and v, in n by m cells, diagonals from low to high.
inline Sheet sheet(const Position& origin, const Position& u, const Position& v, std::size_t n,
                   std::size_t m) {
  Sheet s;
  for (std::size_t i = 0; i <= n; ++i)
    for (std::size_t j = 0; j <= m; ++j) {
      Position p;
      for (std::size_t k = 0; k < 3; ++k)
        p[k] = origin[k] + u[k] * double(i) / double(n) + v[k] * double(j) / double(m);
      s.positions.push_back(p);
    }
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t j = 0; j < m; ++j) {
      const Index a = Index(i * (m + 1) + j), b = Index(a + m + 1);
      s.faces.push_back({a, b, b + 1});
      s.faces.push_back({a, b + 1, a + 1});
    }
  return s;
}

struct Rod {
  std::vector<Position> positions;
  std::vector<std::array<Index, 2>> edges;
};
inline Rod rod(const std::vector<Position>& corners) {
  Rod r{corners, {}};
  for (Index i = 0; i + 1 < corners.size(); ++i) r.edges.push_back({i, i + 1});
  return r;
}

/// A turn and a scale for all coordinates.
struct Motion {
  double turn[3][3], scale;
  Position operator()(const Position& p) const {
    Position q = {0, 0, 0};
    for (std::size_t i = 0; i < 3; ++i)
      for (std::size_t k = 0; k < 3; ++k) q[i] += scale * turn[i][k] * p[k];
    return q;
  }
};
inline Motion motion(unsigned seed) {
  std::mt19937 random(seed);
  std::normal_distribution<double> normal;
  double q[4], sum = 0;
  for (double& x : q) x = seed == 0 ? (&x == q) : normal(random), sum += x * x;
  for (double& x : q) x /= std::sqrt(sum);
  const double w = q[0], x = q[1], y = q[2], z = q[3];
  return {{{1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)},
           {2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)},
           {2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)}},
          seed == 0 ? 1. : std::pow(10., std::uniform_real_distribution<double>(-5, 5)(random))};
}

/// A domain under construction, with the positions that the answers are computed from.
struct Welded {
  explicit Welded(unsigned seed) : move(motion(seed)) {}

  Motion move;
  MixedComplex<double> complex;
  std::vector<Position> positions;
  using Piece = MixedComplex<double>::Piece;

  /// A piece on which paths run at `speed`.
  template <class Shape>
  Piece add(const Shape& shape, double speed = 1) {
    std::vector<Position> moved, timed;
    for (const Position& p : shape.positions) {
      moved.push_back(move(p));
      timed.push_back(moved.back());
      for (double& x : timed.back()) x /= speed;
    }
    positions.insert(positions.end(), shape.positions.begin(), shape.positions.end());
    if constexpr (requires { shape.tets; })
      return complex.add(TetMesh<double>(timed, shape.tets), moved);
    else if constexpr (requires { shape.faces; })
      return complex.add(TriangleMesh<double>(timed, shape.faces), moved);
    else
      return complex.add(Wireframe<double>(timed, shape.edges), moved);
  }
  std::size_t weld(const Piece& a, const Piece& b, WeldOptions options = {}) {
    options.tolerance = 1e-6 * move.scale;
    return complex.weld(a, b, options);
  }
  Index nearest(const Piece& piece, const Position& p) const {
    Index best = piece.first_vertex;
    for (Index v = piece.first_vertex; v < piece.first_vertex + piece.vertices; ++v)
      if (distance(positions[v], p) < distance(positions[best], p)) best = v;
    REQUIRE(distance(positions[best], p) < 1e-12);
    return best;
  }
  /// Greatest error over all vertices, relative to the exact distance or to 1.
  double worst(Index source, const std::function<double(Index)>& exact,
               const PropagateOptions& options = {}) const {
    const auto field = solve(Serial{}, complex, PointSource::at(source), options);
    REQUIRE(field.distance.size() == positions.size());
    double worst = 0;
    for (Index v = 0; v < positions.size(); ++v) {
      const double d = field.distance[v] / move.scale, e = exact(v);
      CAPTURE(v, positions[v][0], positions[v][1], positions[v][2], d, e);
      if (e == infinity || d == infinity) {
        CHECK(d == e);
        continue;
      }
      const double error = std::abs(d - e) / std::max(e, 1.);
      if (error > 1e-3) CHECK(d == Approx(e));
      worst = std::max(worst, error);
    }
    return worst;
  }
  static bool of(const Piece& piece, Index v) {
    return v >= piece.first_vertex && v - piece.first_vertex < piece.vertices;
  }
};

/// What a field is off the truth, as a share of it; `low`: the most that it falls short.
struct Errors {
  double mean = 0, worst = 0, low = 0;
};
inline Errors errors(const Welded& domain, Index source,
                     const std::function<double(Index)>& exact) {
  const auto field = solve(Serial{}, domain.complex, PointSource::at(source));
  Errors e;
  for (Index v = 0; v < domain.positions.size(); ++v) {
    const double truth = exact(v);
    if (truth < 1e-12) continue;
    const double off = (field.distance[v] / domain.move.scale - truth) / truth;
    e.mean += std::abs(off) / double(domain.positions.size());
    e.worst = std::max(e.worst, std::abs(off));
    e.low = std::min(e.low, off);
  }
  return e;
}

}  // namespace mixed_domains
