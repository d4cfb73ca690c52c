#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include <plexway/common/ids.hpp>

namespace plexway::detail {

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
