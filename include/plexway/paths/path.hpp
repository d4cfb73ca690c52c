#pragma once

#include <array>
#include <cstddef>
#include <limits>
#include <optional>
#include <vector>

#include <plexway/common/ids.hpp>

namespace plexway {

/// A point of a simplex, caller's numbers: one coordinate a corner, >= 0, sum 1; 0 beyond them.
struct PathPoint {
  /// It lies in this simplex.
  Index simplex = none;
  /// Its coordinates there.
  std::array<double, 4> barycentric = {0, 0, 0, 0};
};

/// How hard to look for a path on a surface or a cloud.
struct TraceOptions {
  /// The path found is the shortest of all if nowhere near it the field is too long by more than
  /// this share: what could be shorter is searched for, exactly. None: not where windows lead
  /// (Accuracy), else `usual_margin`. 0: not at all, which is some ten times faster; then the path
  /// is locally shortest. Refused where paths are not searched for (Purpose::margins).
  std::optional<double> margin = {};
  /// The margin after labels where none is given.
  static constexpr double usual_margin = 3e-3;
  /// Parts of edges looked at for that at most, 0.2 us each. Where they run out (Path::capped),
  /// half the margin is tried with as many, and so on.
  std::size_t max_windows = 50000;
};

/// A way through a domain, from the point asked for back to the source.
///
/// The straight line from each point to the next lies in the simplex of the first of the two, so
/// the path never leaves the domain. It is empty, and its length +inf, where no path leads; from a
/// source that no simplex has to itself it is empty and 0 long.
struct Path {
  /// From the point asked for to the source.
  std::vector<PathPoint> points;
  /// Where the points are; empty where the domain has no coordinates.
  std::vector<std::array<double, 3>> positions;
  /// Summed over the lines between the points, in double: a path of this length exists, so the
  /// distance is not more. Without the source's offset.
  double length = std::numeric_limits<double>::infinity();
  Index source = none;      ///< where it ends: a place in the list of sources
  std::size_t windows = 0;  ///< looked at (TraceOptions)
  bool capped = false;      ///< they ran out: there may be a shorter path
};

}  // namespace plexway
