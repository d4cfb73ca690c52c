#pragma once

#include <plexway/complex/ids.hpp>

namespace plexway {

/// What a point c of a cloud knows of its virtual source S: the triangle a, b, c over whose edge
/// (a, b) it came, and squared distances from S. Without b it came along the edge (a, c); without
/// a, S is c itself. The distance of c is sigma + sqrt(c2).
template <class Real>
struct PairLabel {
  Index a, b;
  Real a2, b2, c2;
  Real sigma;  ///< walked before S
};

}  // namespace plexway
