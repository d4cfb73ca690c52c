#pragma once

#include "kernel/lanes.hpp"

namespace plexway::detail {

/// What a triangle remembers under Visibility::saddles: the virtual source S of the best path to
/// its centre, and the saddles nearest to the line of sight on either side.
///
/// All are posed on the edge the path came in by, as (x, h): x along it from its first corner, h >=
/// 0 away from the triangle. Left is the side of the first corner. Limits are kept as offsets from
/// S: no limit is an offset of 0, which turning keeps exactly 0.
template <class Real>
struct SaddleLabel {
  kernel::Lanes<Real> x;  ///< S, sigma (walked to S), left and right limit from S
  kernel::Lanes<Real> h;  ///< S, distance of the triangle's centre, left and right limit from S

  [[nodiscard, gnu::always_inline]] Real sigma() const { return x[1]; }
  [[nodiscard, gnu::always_inline]] Real distance() const { return h[1]; }
};

}  // namespace plexway::detail
