#pragma once

#include <array>

namespace plexway::metric {

/// A point or a step in space.
using Point = std::array<double, 3>;

/// A symmetric 3 x 3 matrix M in world coordinates: a short step d is sqrt(d^T M d) long. The
/// identity is the ordinary length; 1 / speed^2 times it is travel time.
struct Tensor {
  ///@{
  /// An entry of the matrix; the other half is the same.
  double xx = 1, xy = 0, xz = 0, yy = 1, yz = 0, zz = 1;
  ///@}

  /// d^T M d: negative along some d where M is not positive.
  [[nodiscard]] constexpr double squared(const Point& d) const {
    return xx * d[0] * d[0] + yy * d[1] * d[1] + zz * d[2] * d[2] +
           2 * (xy * d[0] * d[1] + xz * d[0] * d[2] + yz * d[1] * d[2]);
  }

  /// Travel time at the same speed in all directions.
  [[nodiscard]] static constexpr Tensor of_speed(double speed) {
    const double s = 1 / (speed * speed);
    return {s, 0, 0, s, 0, s};
  }
  /// In the plane z = const; steps along z keep their length.
  [[nodiscard]] static constexpr Tensor planar(double xx, double xy, double yy) {
    return {xx, xy, 0, yy, 0, 1};
  }
};

}  // namespace plexway::metric
