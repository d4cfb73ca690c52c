#pragma once

#include <algorithm>
#include <cstddef>
#include <memory>
#include <mutex>
#include <span>
#include <vector>

#include <plexway/mixed/mixed_complex.hpp>
#include <plexway/solve/distance_field.hpp>
#include <plexway/solve/options.hpp>
#include <plexway/source/point_source.hpp>

#include "strings/media_space.hpp"
#include "strings/solver.hpp"

/// Mixed domains by strings: between the library's sources, options and fields, and theirs.
namespace plexway::detail {

/// A mixed domain as strings see it: its simplices as media in one space. Kept with the domain.
struct MixedSpace {
  /// Null where strings do not go: a piece came without positions, or does not lie there at one
  /// speed a simplex; there is no solid; or a sheet is a curved surface of many facets.
  std::unique_ptr<const strings::MediaSpace> media;
  std::vector<Index> point;  ///< of each vertex of the domain

  /// Cost: n log n.
  template <class Real>
  static std::shared_ptr<const MixedSpace> of(const MixedComplex<Real>& domain);
  /// The number in MediaSpace::simplices of one of the domain.
  [[nodiscard]] Index simplex(Index of_domain) const {
    const auto after = std::upper_bound(pieces_.begin(), pieces_.end(), of_domain,
                                        [](Index s, const Range& r) { return s < r.first; });
    const Range& range = *(after - 1);
    return range.begin + (of_domain - range.first);
  }
  /// And the other way.
  [[nodiscard]] Index outer_simplex(Index of_media) const {
    const Range* range = nullptr;
    for (const Range& r : pieces_)
      if (r.begin <= of_media && (range == nullptr || r.begin >= range->begin)) range = &r;
    return range->first + (of_media - range->begin);
  }
  [[nodiscard]] std::size_t bytes() const {
    return sizeof(*this) + (media ? media->bytes() : 0) + point.capacity() * sizeof(Index) +
           pieces_.capacity() * sizeof(Range);
  }

 private:
  template <class Real>
  class Builder;
  struct Range {
    Index first, begin;  // in the domain's numbers, in the media's
  };
  std::vector<Range> pieces_;
};

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
