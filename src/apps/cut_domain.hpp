#pragma once

#include <cstddef>
#include <memory>
#include <utility>
#include <vector>

#include <plexway/complex/tet_mesh.hpp>
#include <plexway/complex/triangle_mesh.hpp>

#include "apps/bisection.hpp"

namespace plexway {

/// A domain whose edges are no longer than asked for: itself, or a copy cut into smaller simplices.
/// Numbers are those inside.
template <class Complex>
struct CutDomain {
  const Complex* complex = nullptr;  ///< to work on
  std::unique_ptr<Complex> copy;     ///< which this is, or none
  std::vector<double> limits;        ///< one a vertex, of `complex`

  /// Of a copy, by the numbers that its caller knows: which simplex of the domain given each is a
  /// part of, and between which two vertices each new one lies halfway, after those given.
  std::vector<Index> parent;
  std::vector<std::pair<Index, Index>> halved;
};

/// `limits`: the longest edge wanted at each vertex, in the unit inside. Throws TooManyParts where
/// that makes more than `most` simplices.
template <class Real>
CutDomain<TriangleMesh<Real>> cut(const TriangleMesh<Real>& mesh, std::vector<double> limits,
                                  std::size_t most = most_parts);
template <class Real>
CutDomain<TetMesh<Real>> cut(const TetMesh<Real>& mesh, std::vector<double> limits,
                             std::size_t most = most_parts);

}  // namespace plexway
