#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include <plexway/mixed/mixed_complex.hpp>
#include <plexway/shape/shape.hpp>

namespace plexway {

/// A mixed shape as pieces of one dimension and one speed each, welded where they share vertices.
template <class Real>
struct MixedPieces {
  /// `speeds` are one a simplex, or none: 1 for all.
  explicit MixedPieces(const MixedShape& shape, std::span<const double> speeds = {});

  MixedComplex<Real> complex;
  std::vector<Index> vertex;   ///< of each of the shape's vertices, one of the complex; or none
  std::vector<Index> simplex;  ///< likewise
};

}  // namespace plexway
