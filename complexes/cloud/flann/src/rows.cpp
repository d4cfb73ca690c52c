#include "rows.hpp"

#include <cmath>

#include "complexes/common/point3.hpp"

namespace plexway::flann {
using namespace detail;
namespace {

using Offset = std::array<double, 3>;

// The direction in which offsets spread most, by powers of their second moments.
Offset widest_direction(std::span<const Offset> offsets) {
  std::array<Offset, 3> m{};
  for (const Offset& q : offsets)
    for (std::size_t i = 0; i < 3; ++i)
      for (std::size_t j = 0; j < 3; ++j) m[i][j] += q[i] * q[j];
  for (int round = 0; round < 6; ++round) {
    const double trace = m[0][0] + m[1][1] + m[2][2];
    if (!(trace > 0)) return {1, 0, 0};
    std::array<Offset, 3> square{};
    for (std::size_t i = 0; i < 3; ++i)
      for (std::size_t j = 0; j < 3; ++j)
        for (std::size_t k = 0; k < 3; ++k) square[i][j] += m[i][k] / trace * (m[k][j] / trace);
    m = square;
  }
  std::size_t row = 0;
  for (std::size_t i = 1; i < 3; ++i)
    if (m[i][i] > m[row][row]) row = i;
  return unit(m[row]);
}

}  // namespace

RowOfPoints::RowOfPoints(std::span<const Offset> offsets) {
  constexpr std::size_t least = 6;  // fewer tell nothing
  if (offsets.size() < least) return;
  along_ = widest_direction(offsets);
  reach_ = std::sqrt(dot(offsets.back(), offsets.back()));
  // A row is narrow, and the next one just within reach, if at all. On a rim neither is so.
  constexpr double nearest = 0.8, narrow = 0.15;
  Offset first{}, across;
  std::size_t beside = 0;
  double width = 0, length = 0;  // squares
  for (const Offset& q : offsets) {
    if (!is_beside(q, across)) {
      width += dot(across, across);
      length += dot(q, q);
      continue;
    }
    if (dot(q, q) < nearest * nearest * reach_ * reach_) return;
    if (beside++ == 0) first = across;
    if (dot(first, across) < 0) return;  // on both sides
  }
  found_ = beside <= offsets.size() / 5 && width < narrow * narrow * length;
}

// Farther across the row than along it, and not by noise alone.
bool RowOfPoints::is_beside(const Offset& offset, Offset& across) const {
  const double along = dot(along_, offset);
  for (std::size_t d = 0; d < 3; ++d) across[d] = offset[d] - along * along_[d];
  const double off = std::sqrt(dot(across, across));
  return off > std::abs(along) && off > reach_ / 3;
}

std::size_t RowOfPoints::needed(std::span<const Offset> offsets, bool any) const {
  constexpr double more = 1.25;  // of the distance of the first: a few of each row
  Offset first{}, across;
  bool one = false;
  for (const Offset& q : offsets) {
    if (!is_beside(q, across)) continue;
    if (one && !any && dot(first, across) >= 0) continue;
    if (!one) first = across;
    if (!one && !any) {
      one = true;
      continue;
    }
    const double square = more * more * dot(q, q);
    std::size_t count = 0;
    while (count < offsets.size() && dot(offsets[count], offsets[count]) <= square) ++count;
    return count;
  }
  return 0;
}

}  // namespace plexway::flann
