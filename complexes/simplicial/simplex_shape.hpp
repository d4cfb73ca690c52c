#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include <plexway/common/ids.hpp>
#include <plexway/simplicial/detail/simplex_record.hpp>

namespace plexway::detail {

/// Makes N equations diagonal, by rows with the largest pivots first; the right sides are the last
/// column. Unknown i is then m[i][N] / m[i][i], which is no number if the rows depend on each
/// other.
template <std::size_t N>
void eliminate(double (&m)[N][N + 1]) {
  for (std::size_t i = 0; i < N; ++i) {
    std::size_t row = i;
    for (std::size_t k = i + 1; k < N; ++k)
      if (std::abs(m[k][i]) > std::abs(m[row][i])) row = k;
    if (row != i) std::swap_ranges(m[row], m[row] + N + 1, m[i]);
    for (std::size_t k = 0; k < N; ++k)
      if (k != i)
        for (std::size_t d = N + 1; d-- > i;) m[k][d] -= m[k][i] / m[i][i] * m[i][d];
  }
}

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

/// Coordinates of a complex of dimension N, N a vertex, as far from each other as those given,
/// `axes` a vertex; nothing where it does not lie in one flat of that dimension. What is off that
/// by a billionth of the extent changes lengths by the square. Vertices of no simplex are at 0.
template <int N>
std::optional<std::vector<double>> laid_out(std::span<const double> positions, std::size_t axes,
                                            std::span<const std::array<Index, N + 1>> simplices) {
  if (axes == N) return std::vector<double>(positions.begin(), positions.end());
  constexpr double off_flat = 1e-9;
  const auto at = [&](Index v) { return positions.subspan(v * axes, axes); };
  const auto origin = at(simplices[0][0]);
  std::vector<double> basis(N * axes), offset(axes);
  const auto row = [&](std::size_t k) { return std::span(basis).subspan(k * axes, axes); };
  const auto inner = [&](std::span<const double> a, std::span<const double> b) {
    double sum = 0;
    for (std::size_t d = 0; d < axes; ++d) sum += a[d] * b[d];
    return sum;
  };
  const auto from_origin = [&](Index v) {
    for (std::size_t d = 0; d < axes; ++d) offset[d] = at(v)[d] - origin[d];
    return std::span<const double>(offset);
  };
  // What the first `rows` directions of the basis do not have of `offset`; twice, for rounding.
  const auto subtract = [&](std::size_t rows) {
    for (int turn = 0; turn < 2; ++turn)
      for (std::size_t k = 0; k < rows; ++k) {
        const double along = inner(row(k), offset);
        for (std::size_t d = 0; d < axes; ++d) offset[d] -= along * row(k)[d];
      }
    return std::sqrt(inner(offset, offset));
  };
  // Of all vertices the farthest from what is spanned so far, so that the basis is as good as it
  // can be.
  double extent = 0;
  for (std::size_t k = 0; k < N; ++k) {
    double farthest = 0;
    Index best = simplices[0][0];
    for (const auto& corners : simplices)
      for (const Index v : corners) {
        from_origin(v);
        const double off = subtract(k);
        if (off > farthest) farthest = off, best = v;
      }
    if (k == 0) extent = farthest;
    if (!(farthest > off_flat * extent)) return {};
    from_origin(best);
    const double length = subtract(k);
    for (std::size_t d = 0; d < axes; ++d) row(k)[d] = offset[d] / length;
  }
  std::vector<double> laid(N * (positions.size() / axes), 0);
  for (const auto& corners : simplices)
    for (const Index v : corners) {
      from_origin(v);
      for (std::size_t k = 0; k < N; ++k) laid[N * v + k] = inner(row(k), offset);
      if (subtract(N) > off_flat * extent) return {};
    }
  return laid;
}

}  // namespace plexway::detail
