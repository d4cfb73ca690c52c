#pragma once

#include <array>

namespace plexway {

/// Where Visibility::tuned aims on the way from a triangle's apex (0) to its centroid (1), by the
/// triangle's shape over the edge that a path comes in by: a decision table in the form of GSP 2021
/// (section 4), with the six of its sixteen entries that can occur.
struct ProbeTable {
  double slender;  ///< the longest edge is more than this times the one that a path comes in by
  double uneven;   ///< or more than this times the shortest edge
  double low;      ///< the height over the edge that a path comes in by is less than this times it
  /// Neither, uneven only, slender; then the same three where low.
  std::array<double, 6> share;

  /// The published values. Of the fourth threshold there, on height over longest edge, nothing is
  /// left, since a height is never above the longest edge; and what is slender there is uneven.
  static constexpr ProbeTable published() {
    return {5.1424, 4.20638, .504201, {1., .0635997, .0515979, .56903, .0612103, .718198}};
  }
  /// Found on this library's own update rule, by `plexway tune` (docs/TUNING.md).
  static ProbeTable learned();

  bool operator==(const ProbeTable&) const = default;
};

}  // namespace plexway
