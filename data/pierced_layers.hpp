#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

#include "corner_domains.hpp"

/// Two speeds in the plane, rectangles and slits cut out of both: what paths bend at and what hides
/// them reaches over the line between.
namespace samples {

/// Speed `speed[0]` below y = middle, `speed[1]` above. Times by a graph of the corners and of
/// points of the line: too long by about the square of how far these are apart.
struct PiercedLayers {
  CornerDomain plan;
  double middle;
  std::array<double, 2> speed;
  std::size_t points_of_line = 1000;

  [[nodiscard]] bool upper(const Point& p) const { return p[1] > middle; }

  /// From the first of these points. One of the line itself counts as below and above.
  [[nodiscard]] std::vector<double> times(const std::vector<Point>& points) const {
    std::vector<Point> node = {points[0]};
    for (const auto& b : plan.blocks)
      for (const double x : {b.left, b.right})
        for (const double y : {b.bottom, b.top})
          if (x > 0 && x < 1 && y > 0 && y < 1) node.push_back({x, y, 0});
    // Not on a slit, which a line from there would leave to either side; but right beside it.
    constexpr double beside = 1e-8;
    std::vector<double> along;
    for (std::size_t i = 0; i <= points_of_line; ++i)
      along.push_back(static_cast<double>(i) / static_cast<double>(points_of_line));
    for (const auto& b : plan.blocks)
      if (b.bottom <= middle && b.top >= middle) {
        const double off = b.left == b.right ? beside : 0;
        std::erase_if(along, [&](double x) { return std::abs(x - b.left) < off; });
        along.insert(along.end(), {b.left - off, b.right + off});
      }
    for (const double x : along) node.push_back({x, middle, 0});
    constexpr double infinity = std::numeric_limits<double>::infinity();
    std::vector<double> time(node.size(), infinity);
    std::vector<char> done(node.size(), 0);
    time[0] = 0;
    for (;;) {
      std::size_t next = node.size();
      for (std::size_t i = 0; i < node.size(); ++i)
        if (!done[i] && time[i] < infinity && (next == node.size() || time[i] < time[next]))
          next = i;
      if (next == node.size()) break;
      done[next] = 1;
      for (std::size_t i = 0; i < node.size(); ++i)
        if (!done[i]) time[i] = std::min(time[i], time[next] + way(node[next], node[i]));
    }
    std::vector<double> found;
    for (const Point& p : points) {
      double least = infinity;
      for (std::size_t i = 0; i < node.size(); ++i) {
        const double low = time[i] + std::hypot(p[0] - node[i][0], p[1] - node[i][1]) /
                                         std::max(speed[0], speed[1]);
        if (low < least) least = std::min(least, time[i] + way(node[i], p));
      }
      found.push_back(least);
    }
    return found;
  }

 private:
  /// In a straight line on one side of the line between, if nothing is in the way.
  [[nodiscard]] double way(const Point& a, const Point& b) const {
    const double length = std::hypot(a[0] - b[0], a[1] - b[1]);
    const bool below = a[1] <= middle && b[1] <= middle, above = a[1] >= middle && b[1] >= middle;
    if ((!below && !above) || !plan.clear(a, b)) return std::numeric_limits<double>::infinity();
    return length / (below && above ? std::max(speed[0], speed[1]) : speed[below ? 0 : 1]);
  }
};

}  // namespace samples
