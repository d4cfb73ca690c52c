#pragma once

#include <array>

#include <plexway/complex/ids.hpp>

namespace plexway {

/// A point a field starts from: a vertex, or any point of a simplex. Caller's numbers.
struct PointSource {
  Index vertex = none;                            ///< if not none, this vertex
  Index simplex = none;                           ///< else a point of this face
  std::array<double, 3> barycentric = {0, 0, 0};  ///< its coordinates there: >= 0, sum 1
  double offset = 0;                              ///< distance the field starts with, >= 0

  /// At a vertex.
  static PointSource at(Index vertex) { return {.vertex = vertex}; }
  /// At a point of a face.
  static PointSource in(Index simplex, std::array<double, 3> barycentric) {
    return {.simplex = simplex, .barycentric = barycentric};
  }
};

}  // namespace plexway
