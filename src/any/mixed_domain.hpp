#pragma once

#include <cstddef>
#include <vector>

#include <plexway/any/shape.hpp>
#include <plexway/complex/mixed_complex.hpp>

namespace plexway {

/// A mixed shape as pieces of one dimension each, welded where they share vertices.
template <class Real>
struct MixedPieces {
  explicit MixedPieces(const MixedShape& shape);

  MixedComplex<Real> complex;
  std::vector<Index> vertex;   ///< of each of the shape's vertices, one of the complex; or none
  std::vector<Index> simplex;  ///< likewise
};

}  // namespace plexway
