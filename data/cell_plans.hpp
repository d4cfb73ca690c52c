#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <random>
#include <vector>

#include <plexway/common/ids.hpp>

#include "data/cell_lattice.hpp"

namespace samples {

/// Cells, some left out at random, as cubes of tetrahedra; two high.
struct CellPlan {
  static constexpr int cells = 8, high = 2;
  std::vector<char> out = std::vector<char>(cells * cells);
  std::vector<std::array<double, 3>> places;
  std::vector<std::array<int, 2>> corner;  // of the plan, below each
  std::vector<std::array<plexway::Index, 4>> tets;

  CellPlan(std::mt19937& random, double left_out) {
    for (char& o : out) o = static_cast<double>(random()) / 4294967296. < left_out ? 1 : 0;
    constexpr int side = cells + 1;
    std::vector<plexway::Index> number(side * side * (high + 1), plexway::none);
    const auto vertex = [&](const std::array<int, 3>& at) {
      plexway::Index& n = number[static_cast<std::size_t>((at[2] * side + at[1]) * side + at[0])];
      if (n == plexway::none) {
        n = static_cast<plexway::Index>(places.size());
        places.push_back({double(at[0]), double(at[1]), double(at[2])});
        corner.push_back({at[0], at[1]});
      }
      return n;
    };
    for (int k = 0; k < high; ++k)
      for (int j = 0; j < cells; ++j)
        for (int i = 0; i < cells; ++i)
          if (is_cell(i, j)) add_cell({i, j, k}, vertex, tets);
  }
  [[nodiscard]] bool is_cell(int i, int j) const {
    return i >= 0 && j >= 0 && i < cells && j < cells &&
           out[static_cast<std::size_t>(j * cells + i)] == 0;
  }
  /// Along a row of the grid one of the cells beside each step is enough; else no cell that is left
  /// out may be crossed.
  [[nodiscard]] bool sees(const std::array<int, 2>& a, const std::array<int, 2>& b) const {
    const int dx = b[0] - a[0], dy = b[1] - a[1];
    if (dx == 0 || dy == 0) {
      for (int x = std::min(a[0], b[0]); x < std::max(a[0], b[0]); ++x)
        if (!is_cell(x, a[1]) && !is_cell(x, a[1] - 1)) return false;
      for (int y = std::min(a[1], b[1]); y < std::max(a[1], b[1]); ++y)
        if (!is_cell(a[0], y) && !is_cell(a[0] - 1, y)) return false;
      return true;
    }
    for (int j = std::min(a[1], b[1]); j < std::max(a[1], b[1]); ++j)
      for (int i = std::min(a[0], b[0]); i < std::max(a[0], b[0]); ++i) {
        if (is_cell(i, j)) continue;
        int left = 0, right = 0;
        for (const int c : {0, 1, 2, 3}) {
          const int side = dx * (j + c / 2 - a[1]) - dy * (i + c % 2 - a[0]);
          left += side > 0;
          right += side < 0;
        }
        if (left > 0 && right > 0) return false;
      }
    return true;
  }
  [[nodiscard]] std::vector<double> truth(plexway::Index source) const {
    constexpr int side = cells + 1;
    constexpr double infinity = std::numeric_limits<double>::infinity();
    const auto corner_at = [](int n) { return std::array<int, 2>{n % side, n / side}; };
    std::vector<double> flat(side * side, infinity);
    std::vector<char> done(side * side, 0);
    const auto at = [](int n) { return static_cast<std::size_t>(n); };
    flat[at(corner[source][1] * side + corner[source][0])] = 0;
    for (;;) {
      int next = -1;
      for (int n = 0; n < side * side; ++n)
        if (done[at(n)] == 0 && flat[at(n)] < infinity &&
            (next < 0 || flat[at(n)] < flat[at(next)]))
          next = n;
      if (next < 0) break;
      done[at(next)] = 1;
      const auto a = corner_at(next);
      for (int n = 0; n < side * side; ++n) {
        const auto b = corner_at(n);
        const double by = flat[at(next)] + std::hypot(a[0] - b[0], a[1] - b[1]);
        if (by < flat[at(n)] && sees(a, b)) flat[at(n)] = by;
      }
    }
    std::vector<double> truth;
    for (std::size_t v = 0; v < places.size(); ++v)
      truth.push_back(std::hypot(flat[at(corner[v][1] * side + corner[v][0])],
                                 places[v][2] - places[source][2]));
    return truth;
  }
};

}  // namespace samples
