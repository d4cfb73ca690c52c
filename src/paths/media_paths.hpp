#pragma once

#include <array>
#include <span>
#include <vector>

#include <plexway/fields/read_out.hpp>
#include <plexway/paths/path.hpp>
#include <plexway/source/point_source.hpp>

#include "strings/mixed_strings.hpp"

namespace plexway::detail {

/// Paths, and distances of points, on a mixed domain that strings solved: the strings themselves.
class MediaPaths {
 public:
  /// `distance` is the field's, one a vertex, which may end at a radius where strings go on; paths
  /// are drawn between `positions`, one a vertex, or not at all. Refers to all but the distances.
  template <class Real>
  MediaPaths(const MixedStrings& strings, std::span<const Real> distance,
             std::span<const PointSource> sources,
             std::span<const std::array<double, 3>> positions);

  /// The string from a point back to its source, cut where it goes from simplex to simplex. Empty
  /// where none leads.
  [[nodiscard]] Path trace(const PointSource& point) const;
  /// In the domain's unit.
  [[nodiscard]] double at(const PointSource& point, ReadOut level) const;
  [[nodiscard]] std::size_t bytes() const {
    return distance_.capacity() * sizeof(double) + vertex_.capacity() * sizeof(Index);
  }

 private:
  [[nodiscard]] bool is_reached(const PointSource& point) const;
  [[nodiscard]] std::vector<Index> simplices_at(const PointSource& point) const;
  void add(Path& path, Index simplex, const strings::Point& at) const;

  const MixedStrings* strings_;
  const MixedSpace* space_;
  std::span<const PointSource> sources_;
  std::span<const std::array<double, 3>> positions_;
  std::vector<double> distance_;  // of points of the space
  std::vector<Index> vertex_;     // likewise, one of those that lie there; if paths are drawn
};

}  // namespace plexway::detail
