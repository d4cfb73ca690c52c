#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <vector>

#include "mixed_domains.hpp"

/// Solids whose speeds jump at parallel planes, and the times of paths through them.
namespace layered_solids {

using namespace mixed_domains;

/// Speed v[k] between z[k - 1] and z[k].
struct Layers {
  std::vector<double> z, v;

  [[nodiscard]] double low(std::size_t k) const { return k > 0 ? z[k - 1] : -infinity; }
  [[nodiscard]] double high(std::size_t k) const { return k < z.size() ? z[k] : infinity; }

  /// From height a to b, x apart in the planes: each layer between is passed once. Snell's law
  /// leaves one unknown.
  [[nodiscard]] double through(double x, double a, double b) const {
    if (a > b) std::swap(a, b);
    std::vector<double> height, speed;
    double fastest = 0, along = infinity;
    for (std::size_t k = 0; k < v.size(); ++k) {
      if (a >= low(k) && b <= high(k)) along = std::min(along, std::hypot(x, b - a) / v[k]);
      const double h = std::min(b, high(k)) - std::max(a, low(k));
      if (!(h > 0)) continue;
      height.push_back(h);
      speed.push_back(v[k]);
      fastest = std::max(fastest, v[k]);
    }
    if (height.size() < 2) return along;
    const auto reach = [&](double slowness) {
      double sum = 0;
      for (std::size_t i = 0; i < height.size(); ++i) {
        const double sine = slowness * speed[i];
        sum += height[i] * sine / std::sqrt(std::max(1e-300, 1 - sine * sine));
      }
      return sum;
    };
    double least = 0, most = 1 / fastest;
    for (int i = 0; i < 200; ++i) {
      const double middle = (least + most) / 2;
      (reach(middle) < x ? least : most) = middle;
    }
    double time = least * x;
    for (std::size_t i = 0; i < height.size(); ++i) {
      const double sine = least * speed[i];
      time += height[i] / speed[i] * std::sqrt(std::max(0., 1 - sine * sine));
    }
    return time;
  }

  /// The same by way of plane p, along which it runs at the speed of layer k beside it.
  [[nodiscard]] double along(std::size_t p, std::size_t k, double x, double a, double b) const {
    double time = x / v[k], least = 0;
    for (const double end : {a, b})
      for (std::size_t i = 0; i < v.size(); ++i) {
        const double h = std::min(std::max(end, z[p]), high(i)) - std::max(std::min(end, z[p]), low(i));
        if (!(h > 0)) continue;
        const double sine = v[i] / v[k];
        if (sine >= 1) return infinity;
        const double cosine = std::sqrt(1 - sine * sine);
        time += h / v[i] * cosine;
        least += h * sine / cosine;
      }
    return x < least ? infinity : time;
  }

  /// The least of these.
  [[nodiscard]] double time(const Position& p, const Position& q) const {
    const double x = std::hypot(p[0] - q[0], p[1] - q[1]);
    double best = through(x, p[2], q[2]);
    for (std::size_t i = 0; i < z.size(); ++i)
      for (const std::size_t k : {i, i + 1}) best = std::min(best, along(i, k, x, p[2], q[2]));
    return best;
  }
};

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

}  // namespace layered_solids
