#pragma once

#include <cstddef>
#include <memory>
#include <span>
#include <vector>

#include <plexway/simplicial/simplicial_complex.hpp>
#include <plexway/solve/distance_field.hpp>
#include <plexway/solve/options.hpp>
#include <plexway/source/point_source.hpp>

#include "strings/flat/flat_solver.hpp"

namespace plexway::detail {

/// Complexes of four dimensions that lie flat, by strings: between the library's sources, options
/// and fields, and theirs. What a solve leaves; its memory is used again by the next one.
class FlatStrings {
 public:
  /// By one thread: whatever the executor, the same bits.
  template <class Real>
  void solve(const SimplicialComplex<Real, 4>& complex, std::span<const PointSource> sources,
             const PropagateOptions& options, DistanceField<Real>& field);

  [[nodiscard]] std::size_t bytes() const {
    return sizeof(*this) + (solver_ ? solver_->bytes() : 0) +
           roots_.capacity() * sizeof(strings::FlatRoot);
  }

 private:
  std::shared_ptr<const strings::FlatSpace<4>> space_;  // the complex keeps it
  std::unique_ptr<strings::FlatSolver<4>> solver_;
  std::vector<strings::FlatRoot> roots_;
};

}  // namespace plexway::detail
