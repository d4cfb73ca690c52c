#pragma once

#include <array>
#include <cmath>
#include <cstddef>

#include <plexway/simplicial/detail/simplex_record.hpp>

namespace plexway::detail {

enum class FlatVerdict { flat, degenerate, violated };

/// Is there a Euclidean simplex with these lengths? By elimination with pivots on the inner
/// products of the edges from corner 0, which must be positive (semi)definite (Schoenberg 1935).
/// Rounding of the lengths is forgiven.
template <int N>
FlatVerdict simplex_shape(const std::array<double, N*(N + 1) / 2>& lengths) {
  using Layout = SimplexLayout<N>;
  double longest = 0;
  for (const double l : lengths) longest = std::fmax(longest, l);
  if (longest == 0) return FlatVerdict::degenerate;
  const auto square = [&](std::size_t a, std::size_t b) {
    const double l = lengths[Layout::edge(a, b)] / longest;
    return l * l;
  };
  double inner[N][N];
  for (std::size_t a = 0; a < N; ++a)
    for (std::size_t b = 0; b < N; ++b)
      inner[a][b] = a == b ? square(0, a + 1)
                           : .5 * (square(0, a + 1) + square(0, b + 1) - square(a + 1, b + 1));
  bool used[N] = {};
  for (std::size_t step = 0; step < N; ++step) {
    std::size_t pivot = N;
    double least = 0, off = 0;
    for (std::size_t a = 0; a < N; ++a) {
      if (used[a]) continue;
      least = std::fmin(least, inner[a][a]);
      for (std::size_t b = 0; b < N; ++b)
        if (!used[b] && a != b) off = std::fmax(off, std::abs(inner[a][b]));
      if (pivot == N || inner[a][a] > inner[pivot][pivot]) pivot = a;
    }
    constexpr double rounding = 1e-12;
    if (least < -rounding) return FlatVerdict::violated;
    if (inner[pivot][pivot] <= rounding)
      return off > 10 * rounding ? FlatVerdict::violated : FlatVerdict::degenerate;
    used[pivot] = true;
    for (std::size_t a = 0; a < N; ++a)
      for (std::size_t b = 0; b < N; ++b)
        if (!used[a] && !used[b])
          inner[a][b] -= inner[a][pivot] * inner[pivot][b] / inner[pivot][pivot];
  }
  return FlatVerdict::flat;
}

}  // namespace plexway::detail
