#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

/// Exact distances on the surface of the unit cube.
namespace plexway::testing {

namespace cube_detail {

using Plane = std::array<double, 2>;

// The side x[axis] = place of the cube, laid into the plane: the point x is at
// origin + the sum of x[k] image[k].
struct Side {
  std::size_t axis;
  int place;
  Plane origin;
  std::array<Plane, 3> image;

  [[nodiscard]] Plane of(const std::array<double, 3>& x) const {
    Plane p = origin;
    for (std::size_t k = 0; k < 3; ++k)
      for (std::size_t i = 0; i < 2; ++i) p[i] += x[k] * image[k][i];
    return p;
  }
};

struct Edge {
  Plane from, to;
};

inline double turn(const Plane& a, const Plane& b, const Plane& c) {
  return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
}

inline bool on(const std::array<double, 3>& x, std::size_t axis, int place) {
  return std::abs(x[axis] - place) < 1e-12;
}

// The shortest straight line from `from` to `to` over sequences of sides that go on with `side`.
inline double search(const Side& side, const Plane& from, const std::array<double, 3>& to,
                     std::array<Edge, 6>& edges, int depth, unsigned seen) {
  double best = std::numeric_limits<double>::infinity();
  if (on(to, side.axis, side.place)) {
    const Plane q = side.of(to);
    bool lit = true;
    for (int e = 0; e < depth; ++e)
      lit = lit && turn(from, q, edges[static_cast<std::size_t>(e)].from) *
                           turn(from, q, edges[static_cast<std::size_t>(e)].to) <=
                       1e-12;
    if (lit) best = std::hypot(q[0] - from[0], q[1] - from[1]);
  }
  if (depth == 5) return best;  // that was the last side
  for (std::size_t j = 0; j < 3; ++j) {
    if (j == side.axis) continue;
    const std::size_t m = 3 - j - side.axis;
    for (int place = 0; place < 2; ++place) {
      const unsigned bit = 1u << (2 * j + static_cast<unsigned>(place));
      if (seen & bit) continue;
      // The next side goes on outward where this one ends.
      Side next{j, place, side.origin, side.image};
      const double out = place == 1 ? 1 : -1, in = side.place == 1 ? -1 : 1;
      for (std::size_t i = 0; i < 2; ++i) {
        next.image[j][i] = 0;
        next.image[side.axis][i] = in * out * side.image[j][i];
        next.origin[i] += place * side.image[j][i];
        if (side.place == 1) next.origin[i] -= next.image[side.axis][i];
      }
      Edge& edge = edges[static_cast<std::size_t>(depth)];
      for (std::size_t i = 0; i < 2; ++i) {
        edge.from[i] = side.origin[i] + place * side.image[j][i];
        edge.to[i] = edge.from[i] + side.image[m][i];
      }
      best = std::min(best, search(next, from, to, edges, depth + 1, seen | bit));
    }
  }
  return best;
}

}  // namespace cube_detail

/// The length of the shortest path on the surface of [0, 1]^3 between two of its points: the least
/// over all sequences of sides that are unfolded into the plane and crossed by the straight line.
inline double cube_distance(const std::array<double, 3>& a, const std::array<double, 3>& b) {
  using namespace cube_detail;
  for (std::size_t axis = 0; axis < 3; ++axis)
    for (int place = 0; place < 2; ++place) {
      if (!on(a, axis, place)) continue;
      Side side{axis, place, {0, 0}, {}};
      side.image[(axis + 1) % 3] = {1, 0};
      side.image[(axis + 2) % 3] = {0, 1};
      std::array<Edge, 6> edges;
      return search(side, side.of(a), b, edges, 0, 1u << (2 * axis + static_cast<unsigned>(place)));
    }
  return std::numeric_limits<double>::infinity();
}

}  // namespace plexway::testing
