#pragma once

#include <cstddef>
#include <memory>
#include <mutex>
#include <span>
#include <vector>

#include <plexway/mixed/mixed_complex.hpp>
#include <plexway/solve/distance_field.hpp>
#include <plexway/solve/options.hpp>
#include <plexway/source/point_source.hpp>

#include "strings/mixed_space.hpp"
#include "strings/solver.hpp"

/// Mixed domains by strings: between the library's sources, options and fields, and theirs.
namespace plexway::detail {

/// What a solve by strings leaves; its memory is used again by the next one.
class MixedStrings {
 public:
  /// The same bits for any number of threads. `space` has media.
  template <class Real>
  void solve(const MixedComplex<Real>& domain, std::shared_ptr<const MixedSpace> space,
             std::span<const PointSource> sources, const PropagateOptions& options,
             const strings::Threads& threads, DistanceField<Real>& field);

  /// The shortest path to a point; its bends and both ends, from the source on, as the space has
  /// them, and the medium of each leg. No points where no path leads.
  struct Found {
    double distance;  ///< in the domain's unit
    Index source;
    std::vector<strings::Point> points;
    std::vector<Index> media;
  };
  /// Any number of threads may ask, one after the other.
  [[nodiscard]] Found at(const PointSource& point) const;

  /// That of the last solve.
  [[nodiscard]] const MixedSpace& space() const { return *space_; }
  [[nodiscard]] std::size_t bytes() const;

 private:
  std::shared_ptr<const MixedSpace> space_;
  std::unique_ptr<strings::Solver> solver_;
  mutable std::mutex asked_;
  std::vector<strings::Source> sources_;
  std::vector<std::vector<strings::Inside>> inside_;  // of each
};

}  // namespace plexway::detail
