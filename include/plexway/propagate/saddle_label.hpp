#pragma once

#include <plexway/kernel/lanes.hpp>

namespace plexway {

/// What a triangle remembers under Visibility::saddles: the virtual source S of the best path to
/// its centre, and the saddles nearest to the line of sight on either side.
///
/// All are posed on the edge the path came in by, as (x, h): x along it from its first corner, h >=
/// 0 away from the triangle. Left is the side of the first corner. A limit that equals S is none.
template <class Real>
struct SaddleLabel {
  kernel::Lanes<Real> x;  ///< S, left limit, right limit, sigma (walked from the source to S)
  kernel::Lanes<Real> h;  ///< S, left limit, right limit, distance of the triangle's centre
};

}  // namespace plexway
