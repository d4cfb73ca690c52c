#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <map>
#include <random>
#include <vector>

#include <plexway/common/ids.hpp>

#include "speed_times.hpp"

/// Pieces of mixed domains: blocks, sheets, rods, a ball and its skin, layers.
namespace samples {

using plexway::Index;
using plexway::none;

struct Block {
  std::vector<Position> positions;
  std::vector<std::array<Index, 4>> tets;
};

/// The box from `low` to `high` in so many cells along each axis, each cut into six tetrahedra
/// about a diagonal.
inline Block block(const Position& low, const Position& high, const std::array<std::size_t, 3>& n) {
  Block b;
  const std::size_t m[3] = {n[0] + 1, n[1] + 1, n[2] + 1};
  for (std::size_t i = 0; i < m[0]; ++i)
    for (std::size_t j = 0; j < m[1]; ++j)
      for (std::size_t k = 0; k < m[2]; ++k) {
        const auto at = [&](std::size_t axis, std::size_t step) {
          return low[axis] + (high[axis] - low[axis]) * double(step) / double(n[axis]);
        };
        b.positions.push_back({at(0, i), at(1, j), at(2, k)});
      }
  const std::size_t stride[3] = {m[1] * m[2], m[2], 1};
  constexpr int orders[6][3] = {{0, 1, 2}, {0, 2, 1}, {1, 0, 2}, {1, 2, 0}, {2, 0, 1}, {2, 1, 0}};
  for (std::size_t i = 0; i < n[0]; ++i)
    for (std::size_t j = 0; j < n[1]; ++j)
      for (std::size_t k = 0; k < n[2]; ++k)
        for (const auto& order : orders) {
          std::size_t v = i * stride[0] + j * stride[1] + k;
          std::array<Index, 4> tet = {Index(v), 0, 0, 0};
          for (std::size_t c = 0; c < 3; ++c) tet[c + 1] = Index(v += stride[order[c]]);
          b.tets.push_back(tet);
        }
  return b;
}
inline Block block(const Position& low, const Position& high, std::size_t n) {
  return block(low, high, {n, n, n});
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

/// The unit ball, a block blown up, and its surface.
inline Block ball(std::size_t n) {
  Block b = block({-1, -1, -1}, {1, 1, 1}, n);
  for (Position& p : b.positions) {
    const double cube = std::max({std::abs(p[0]), std::abs(p[1]), std::abs(p[2])});
    const double r = std::hypot(p[0], p[1], p[2]);
    for (double& x : p) x *= r > 0 ? cube / r : 1;
  }
  return b;
}
inline Sheet skin_of(const Block& b) {
  std::map<std::array<Index, 3>, int> faces;
  for (const auto& tet : b.tets)
    for (std::size_t i = 0; i < 4; ++i) {
      std::array<Index, 3> face = {tet[(i + 1) % 4], tet[(i + 2) % 4], tet[(i + 3) % 4]};
      std::sort(face.begin(), face.end());
      ++faces[face];
    }
  Sheet s;
  std::map<Index, Index> number;
  for (const auto& [face, tets] : faces) {
    if (tets > 1) continue;
    std::array<Index, 3> own;
    for (std::size_t i = 0; i < 3; ++i) {
      const auto [it, is_new] = number.insert({face[i], static_cast<Index>(s.positions.size())});
      if (is_new) s.positions.push_back(b.positions[face[i]]);
      own[i] = it->second;
    }
    s.faces.push_back(own);
  }
  return s;
}

/// Cells n a side over a parallelogram, upright and one high, their inner vertices moved at random
/// by `jitter` of a cell (in planes of the layers along these); a block for each layer.
inline std::vector<Block> blocks_of(const Layers& layers, std::size_t n, double jitter,
                                    unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> uniform(-jitter / double(n), jitter / double(n));
  std::vector<double> height = {0};
  std::vector<std::size_t> layer;  // of each row of cells
  for (std::size_t k = 0; k < layers.v.size(); ++k) {
    const double from = height.back(), to = k < layers.z.size() ? layers.z[k] : 1;
    const std::size_t last = k < layers.z.size() ? std::size_t(std::lround(to * double(n))) : n;
    const std::size_t rows = std::max<std::size_t>(last, layer.size() + 1) - layer.size();
    for (std::size_t i = 1; i <= rows; ++i) {
      height.push_back(from + (to - from) * double(i) / double(rows));
      layer.push_back(k);
    }
  }
  Block all = block({0, 0, 0}, {1, 1, 1}, n);
  const std::size_t m = n + 1;
  for (std::size_t v = 0; v < all.positions.size(); ++v) {
    Position& p = all.positions[v];
    const std::size_t cell[3] = {v / (m * m), v / m % m, v % m};
    const bool inner = cell[2] > 0 && cell[2] < n;
    p[2] = height[cell[2]];
    for (std::size_t i = 0; i < 3; ++i) {
      const double by = uniform(random);
      const bool fixed =
          i < 2 ? cell[i] == 0 || cell[i] == n : !inner || layer[cell[2]] != layer[cell[2] - 1];
      if (!fixed) p[i] += by;
    }
    p[0] += 0.2 * p[1];
  }
  std::vector<Block> blocks(layers.v.size());
  for (std::size_t k = 0; k < blocks.size(); ++k) {
    std::vector<Index> number(all.positions.size(), none);
    for (std::size_t t = 0; t < all.tets.size(); ++t) {
      if (layer[t / 6 % n] != k) continue;
      blocks[k].tets.push_back(all.tets[t]);
      for (Index& v : blocks[k].tets.back()) {
        if (number[v] == none) {
          number[v] = static_cast<Index>(blocks[k].positions.size());
          blocks[k].positions.push_back(all.positions[v]);
        }
        v = number[v];
      }
    }
  }
  return blocks;
}

}  // namespace samples
