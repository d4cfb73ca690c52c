#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "shapes.hpp"

/// Flat domains with corners that shortest paths bend around, on grids as fine as one likes, and
/// the exact distances by a visibility graph of the corners. What a rule for surfaces forgets of a
/// corner shows here, and nothing else: there is no curvature.
namespace samples {

/// The unit square without some rectangles. Those of no width are slits, with a vertex on each lip.
struct CornerDomain {
  struct Block {
    double left, right, bottom, top;
  };
  std::string name;
  std::vector<Block> blocks;  ///< sides at multiples of 1 / 50
  std::array<double, 2> source;

  /// Does a straight line from a to b stay clear of the blocks? It may touch them.
  [[nodiscard]] bool clear(Point a, Point b) const {
    const auto blocked = [&](const Block& block) {
      double begin = 0, end = 1;  // the part of the line within the block
      const std::array<double, 2> low = {block.left, block.bottom}, high = {block.right, block.top};
      for (std::size_t i = 0; i < 2; ++i) {
        const double way = b[i] - a[i];
        const bool slit = low[i] == high[i];
        if (slit && (a[i] - low[i]) * (b[i] - low[i]) >= 0) return false;  // on one side of it
        const double margin = slit ? -1e-12 : 1e-12;
        if (std::abs(way) < 1e-14) {
          if (a[i] < low[i] + margin || a[i] > high[i] - margin) return false;
          continue;
        }
        const double s = (low[i] + margin - a[i]) / way, t = (high[i] - margin - a[i]) / way;
        begin = std::max(begin, std::min(s, t));
        end = std::min(end, std::max(s, t));
      }
      return begin <= end;
    };
    return std::none_of(blocks.begin(), blocks.end(), blocked);
  }

  /// Exact distances of points from the first of them.
  [[nodiscard]] std::vector<double> distances(const std::vector<Point>& points) const {
    std::vector<Point> corner = {points[0]};
    for (const Block& b : blocks)
      for (const double x : {b.left, b.right})
        for (const double y : {b.bottom, b.top})
          if (x > 0 && x < 1 && y > 0 && y < 1) corner.push_back({x, y, 0});
    constexpr double infinity = std::numeric_limits<double>::infinity();
    const auto gap = [](Point a, Point b) { return std::sqrt(dot(a - b, a - b)); };
    std::vector<double> walked(corner.size(), infinity);
    walked[0] = 0;
    for (std::size_t round = 0; round < corner.size(); ++round)
      for (std::size_t i = 0; i < corner.size(); ++i)
        for (std::size_t j = 0; j < corner.size(); ++j)
          if (walked[i] + gap(corner[i], corner[j]) < walked[j] && clear(corner[i], corner[j]))
            walked[j] = walked[i] + gap(corner[i], corner[j]);
    std::vector<double> distance;
    for (const Point& p : points) {
      double least = infinity;
      for (std::size_t i = 0; i < corner.size(); ++i)
        if (walked[i] + gap(corner[i], p) < least && clear(corner[i], p))
          least = walked[i] + gap(corner[i], p);
      distance.push_back(least);
    }
    return distance;
  }

  /// A grid of n by n cells (n a multiple of 50), its vertices moved at random by up to `jitter` of
  /// a cell; those on sides stay on them. Point 0 is the source.
  [[nodiscard]] Shape grid(Index n, double jitter = 0.25, std::uint64_t seed = 1) const {
    Noise noise(seed);
    Shape shape;
    const auto at = [&](Index i) { return static_cast<double>(i) / n; };
    const auto within = [](double x, double low, double high) {
      return x > low - 1e-9 && x < high + 1e-9;
    };
    const auto si = static_cast<Index>(std::lround(source[0] * n));
    const auto sj = static_cast<Index>(std::lround(source[1] * n));
    constexpr Index nowhere = ~Index{0};
    std::vector<Index> number((n + 1) * (n + 1), nowhere), other = number;
    const auto place = [&](Index i, Index j) {
      double x = at(i), y = at(j);
      const double dx = noise() * jitter / n, dy = noise() * jitter / n;
      bool moves_x = i > 0 && i<n, moves_y = j> 0 && j < n, on_slit = false;
      for (const Block& b : blocks) {
        if (!within(x, b.left, b.right) || !within(y, b.bottom, b.top)) continue;
        const bool side = !within(x, b.left + 2e-9, b.right - 2e-9);
        const bool end = !within(y, b.bottom + 2e-9, b.top - 2e-9);
        if (b.left == b.right && y < b.top - 1e-9 && y > b.bottom - 1e-9) on_slit = true;
        if (!side && !end) return;  // inside
        moves_x = moves_x && !side;
        moves_y = moves_y && !end;
      }
      const bool is_source = i == si && j == sj;
      if (moves_x && moves_y && !is_source) x += dx, y += dy;
      const Index v = j * (n + 1) + i;
      // A slit's lips are apart by less than what shows.
      number[v] = shape.add({on_slit ? x - 1e-13 : x, y, 0});
      if (on_slit) other[v] = shape.add({x + 1e-13, y, 0});
    };
    place(si, sj);
    for (Index j = 0; j <= n; ++j)
      for (Index i = 0; i <= n; ++i)
        if (i != si || j != sj) place(i, j);
    for (Index j = 0; j < n; ++j)
      for (Index i = 0; i < n; ++i) {
        const double x = at(i) + 0.5 / n, y = at(j) + 0.5 / n;
        if (std::any_of(blocks.begin(), blocks.end(), [&](const Block& b) {
              return x > b.left && x < b.right && y > b.bottom && y < b.top;
            }))
          continue;
        const auto corner = [&](Index a, Index b) {
          const Index v = b * (n + 1) + a;
          return other[v] != nowhere && a == i ? other[v] : number[v];
        };
        add_quad(shape, corner(i, j), corner(i + 1, j), corner(i + 1, j + 1), corner(i, j + 1));
      }
    return shape;
  }
};

inline std::vector<CornerDomain> corner_domains() {
  return {{"notch", {{.4, .6, 0, .6}}, {.1, .2}},
          {"ell", {{.5, 1, 0, .5}}, {.2, .1}},
          {"block", {{.4, .6, .4, .6}}, {.2, .44}},
          {"slit", {{.5, .5, 0, .5}}, {.3, .2}},
          {"comb",
           {{.18, .22, 0, .7}, {.38, .42, .3, 1}, {.58, .62, 0, .7}, {.78, .82, .3, 1}},
           {.08, .1}}};
}

}  // namespace samples
