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
  /// Found on this library's own update rule, by `plexway tune`: plexway 0.1.0, 2026-11-21, on the
  /// training set of bench/tune.sh (28 surfaces with the bunny of data/fetch.sh, 56 fields, digest
  /// 03dd5f44d6423207):
  ///   plexway tune training/*.obj --seed 2 --evaluations 300 --restarts 3
  /// Mean error there 5.435e-03; centroid 8.944e-03, published table 6.678e-03. docs/log/tuning.md
  /// has those it was not trained on.
  static constexpr ProbeTable learned() {
    return {11.7528, 1.53965, 1.20639, {1.01992, 0.86097, 0.853053, 1.12208, 0.661627, 1.19274}};
  }

  /// Are all numbers the same?
  bool operator==(const ProbeTable&) const = default;
};

}  // namespace plexway
