#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <optional>

#include <plexway/complex/detail/triangle_record.hpp>

namespace plexway::windows {

/// A point of a triangle that all but lies at a corner, and how far from it.
struct NearCorner {
  std::size_t corner;
  double way;
};

/// Seen from so near, a corner lies in no direction that rounding leaves right: light starts at the
/// corner then, with the way there added, and is at most twice that way too long. Barycentric
/// coordinates `b`; the share of an edge that is near is 3e-5 in float, 1e-9 in double.
template <class Real>
[[nodiscard]] std::optional<NearCorner> near_corner(const TriangleRecord<Real>& t,
                                                    const std::array<double, 4>& b) {
  constexpr double near = sizeof(Real) == sizeof(float) ? 3e-5 : 1e-9;
  const std::size_t corner =
      static_cast<std::size_t>(std::max_element(b.begin(), b.begin() + 3) - b.begin());
  if (b[corner] < 1 - near) return std::nullopt;
  const auto squared = [&](std::size_t edge) {
    const double length = static_cast<double>(t.length[edge]);
    return length * length;
  };
  const std::size_t after = edge_after(corner), before = edge_before(corner);
  const double to_after = squared(corner), to_before = squared(before), across = squared(after);
  return NearCorner{
      corner,
      std::sqrt(std::max(0., b[after] * b[after] * to_after + b[before] * b[before] * to_before +
                                 b[after] * b[before] * (to_after + to_before - across)))};
}

}  // namespace plexway::windows
