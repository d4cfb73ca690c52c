#pragma once

#include <array>
#include <cstddef>

#include <plexway/common/ids.hpp>

namespace plexway {

/// A point a field starts from: a vertex, or any point of a simplex. Caller's numbers.
struct PointSource {
  Index vertex = none;   ///< if not none, this vertex
  Index simplex = none;  ///< else a point of this simplex
  /// Its coordinates there: >= 0, sum 1, one a corner; 0 beyond the simplex's own corners.
  std::array<double, 4> barycentric = {0, 0, 0, 0};
  double offset = 0;  ///< distance the field starts with, >= 0

  /// At a vertex.
  static PointSource at(Index vertex) { return {.vertex = vertex}; }
  /// At a point of a simplex, by one coordinate a corner (at most four).
  template <std::size_t N>
  static PointSource in(Index simplex, const std::array<double, N>& barycentric) {
    static_assert(N <= 4, "simplices have at most four corners");
    PointSource source{.simplex = simplex};
    for (std::size_t i = 0; i < N; ++i) source.barycentric[i] = barycentric[i];
    return source;
  }
  /// The same for coordinates in braces: PointSource::in(7, {.5, .25, .25}).
  template <std::size_t N>
  static PointSource in(Index simplex, const double (&barycentric)[N]) {
    return in(simplex, std::to_array(barycentric));
  }
};

}  // namespace plexway
