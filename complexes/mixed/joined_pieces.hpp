#pragma once

#include <memory>
#include <vector>

#include <plexway/mixed/mixed_complex.hpp>

namespace plexway {

/// A mixed domain as executors work on it: fewer pieces, and where each of the caller's vertices
/// and simplices is in them. A corner that exists only once pieces are welded is then one of a
/// complex, whose rule knows what to do about it.
template <class Real>
struct JoinedPieces {
  MixedComplex<Real> domain;
  std::vector<Index> vertex, simplex;

  /// Null if nothing is to be joined. Cost: that of building the complexes anew.
  static std::shared_ptr<const JoinedPieces> of(const MixedComplex<Real>& given);

  [[nodiscard]] std::size_t bytes() const {
    return domain.bytes() + (vertex.capacity() + simplex.capacity()) * sizeof(Index);
  }
};

extern template struct JoinedPieces<float>;
extern template struct JoinedPieces<double>;

}  // namespace plexway
