#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <vector>

#include "executors/growth.hpp"

namespace plexway {

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

/// The content of each of so many cells. A simplex at a border is shared out where the distances
/// that the labels on it and around it promise at its corners, linear between them, are equal: off
/// by the square of an edge, where counting each simplex as its centre's is off by an edge. The
/// cells add up to what is reached. Cost: linear.
template <class Complex>
std::vector<double> cell_contents(Growth<Complex>& field, std::size_t cells) {
  constexpr std::size_t corners = Growth<Complex>::corners;
  std::vector<double> content(cells, 0);
  std::vector<Index> here;
  typename SimplexParts<corners>::Values values;
  for (Index s = 0; s < field.simplices(); ++s) {
    if (!field.reached(s)) continue;
    here.clear();
    for (auto& of : values) of.clear();
    field.each_label(s, [&](Index cell, const auto& distance) {
      const auto known = std::find(here.begin(), here.end(), cell);
      const auto n = static_cast<std::size_t>(known - here.begin());
      if (known == here.end()) here.push_back(cell);
      for (std::size_t k = 0; k < corners; ++k) {
        Weights at{};
        at[k] = 1;
        // Where it promises nothing the others have it.
        const double d = std::min(static_cast<double>(distance(at)), 1e30);
        if (n == values[k].size())
          values[k].push_back(d);
        else
          values[k][n] = std::min(values[k][n], d);
      }
      return false;
    });
    const auto whole = static_cast<double>(field.measure(s));
    const auto share = SimplexParts<corners>::shares(values);
    for (std::size_t n = 0; n < here.size(); ++n) content[here[n]] += whole * share[n];
  }
  return content;
}

}  // namespace plexway
