#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>

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

}  // namespace plexway::detail
