#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <vector>

#include "executors/solid_growth.hpp"
#include "executors/surface_growth.hpp"

namespace plexway::detail {

/// Shares of a simplex by functions that are linear in it: it is cut at edges where the least of
/// them changes, until it does nowhere.
template <std::size_t Corners>
class SimplexParts {
 public:
  /// The values that compete, at each corner.
  using Values = std::array<std::vector<double>, Corners>;

  /// The share of the simplex in which each of the functions is the least of all.
  static std::vector<double> shares(const Values& values) {
    std::vector<double> share(values[0].size(), 0);
    for (std::size_t n = 0; n < share.size(); ++n) share[n] = least(values, n, 0, 1);
    return share;
  }

 private:
  static double least(const Values& values, std::size_t n, std::size_t other, double content) {
    if (other == n) ++other;
    if (other >= values[0].size()) return content;
    std::array<double, Corners> over{};
    std::size_t high = 0, low = 0;
    for (std::size_t k = 0; k < Corners; ++k) {
      // Where two are equal the first has it.
      over[k] = values[k][n] - values[k][other];
      if (over[k] > over[high]) high = k;
      if (over[k] < over[low]) low = k;
    }
    const bool first = n < other;
    if (over[high] < 0 || (first && over[high] == 0)) return least(values, n, other + 1, content);
    if (over[low] > 0 || (!first && over[low] == 0)) return 0;
    if (over[high] == 0 || over[low] == 0)
      return over[high] == 0 ? least(values, n, other + 1, content) : 0;
    const double t = over[low] / (over[low] - over[high]);  // from low to high
    Values below = values, above = values;
    for (std::size_t m = 0; m < values[0].size(); ++m)
      below[high][m] = above[low][m] = (1 - t) * values[low][m] + t * values[high][m];
    below[high][n] = below[high][other];
    above[low][n] = above[low][other];
    return least(below, n, other, content * t) + least(above, n, other, content * (1 - t));
  }
};

/// A simplex in parts of equal content, by its corners and the middles of its edges: points as
/// weights, parts as points.
template <std::size_t Corners>
struct HalvedSimplex {
  static constexpr std::size_t points = Corners * (Corners + 1) / 2;
  static constexpr auto ends = [] {
    std::array<std::array<std::size_t, 2>, points> found{};
    std::size_t n = 0;
    for (; n < Corners; ++n) found[n] = {n, n};
    for (std::size_t i = 0; i < Corners; ++i)
      for (std::size_t j = i + 1; j < Corners; ++j) found[n++] = {i, j};
    return found;
  }();
  static constexpr auto parts = [] {
    if constexpr (Corners == 3)
      return std::array<std::array<std::size_t, 3>, 4>{
          {{0, 3, 4}, {1, 3, 5}, {2, 4, 5}, {3, 4, 5}}};
    else  // what is left between the corners is cut along the line from one middle to the opposite
      return std::array<std::array<std::size_t, 4>, 8>{{{0, 4, 5, 6},
                                                        {1, 4, 7, 8},
                                                        {2, 5, 7, 9},
                                                        {3, 6, 8, 9},
                                                        {4, 9, 5, 7},
                                                        {4, 9, 7, 8},
                                                        {4, 9, 8, 6},
                                                        {4, 9, 6, 5}}};
  }();
};

/// The content of each of so many cells. A simplex at a border is shared out where the distances
/// that the labels on it and around it promise at its corners and the middles of its edges, linear
/// between them, are equal: off by the square of half an edge, where counting each simplex as its
/// centre's is off by an edge. The cells add up to what is reached. Cost: linear.
template <class Complex>
std::vector<double> cell_contents(Growth<Complex>& field, std::size_t cells) {
  constexpr std::size_t corners = Growth<Complex>::corners;
  using Halved = HalvedSimplex<corners>;
  std::vector<double> content(cells, 0);
  std::vector<Index> here;
  std::array<std::vector<double>, Halved::points> values;
  typename SimplexParts<corners>::Values part;
  for (Index s = 0; s < field.simplices(); ++s) {
    if (!field.reached(s)) continue;
    here.clear();
    for (auto& of : values) of.clear();
    field.each_label(s, [&](Index cell, const auto& distance) {
      const auto known = std::find(here.begin(), here.end(), cell);
      const auto n = static_cast<std::size_t>(known - here.begin());
      if (known == here.end()) here.push_back(cell);
      for (std::size_t k = 0; k < Halved::points; ++k) {
        Weights at{};
        for (const std::size_t end : Halved::ends[k]) at[end] += 0.5;
        // Where it promises nothing the others have it.
        const double d = std::min(static_cast<double>(distance(at)), 1e30);
        if (n == values[k].size())
          values[k].push_back(d);
        else
          values[k][n] = std::min(values[k][n], d);
      }
      return false;
    });
    const double whole = static_cast<double>(field.measure(s)) / Halved::parts.size();
    for (const auto& piece : Halved::parts) {
      for (std::size_t k = 0; k < corners; ++k) part[k] = values[piece[k]];
      const auto share = SimplexParts<corners>::shares(part);
      for (std::size_t n = 0; n < here.size(); ++n) content[here[n]] += whole * share[n];
    }
  }
  return content;
}

}  // namespace plexway::detail
