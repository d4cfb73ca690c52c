#pragma once

#include <cmath>
#include <vector>

#include "complexes/test_solids.hpp"
#include "labels/solid_solving.hpp"

/// Exact distances in solids made on the spot.
namespace plexway::testing {

/// Around the reflex edge of l_shape at (1/2, 1/2).
inline std::vector<double> around_l(const Solid& s, const Position& a) {
  std::vector<double> d;
  for (const Position& p : s.positions) {
    const double ax = a[0] - .5, ay = a[1] - .5, px = p[0] - .5, py = p[1] - .5;
    // From arm to arm, the line is blocked if it crosses x = 1/2 above y = 1/2.
    bool inside = false;
    if ((ax > 0 && py > 0) || (ay > 0 && px > 0)) {
      const double f = (0 - ax) / (px - ax);
      inside = ay + f * (py - ay) > 1e-12;
    }
    const double z = p[2] - a[2];
    d.push_back(inside ? over(std::hypot(ax, ay) + std::hypot(px, py), z)
                       : std::hypot(ax - px, ay - py, z));
  }
  return d;
}

/// Over the wall of `walled`, from a source in front of it: the edges are at x = 3/8 and 5/8,
/// y = 3/4. In the plane a taut string over a convex corner pair.
inline std::vector<double> over_wall(const Solid& s, const Position& a) {
  std::vector<double> d;
  for (const Position& p : s.positions) {
    const double ax = a[0], ay = a[1], px = p[0], py = p[1];
    const auto below = [](double x0, double y0, double x1, double y1, double x) {
      return y0 + (y1 - y0) * (x - x0) / (x1 - x0) < .75 - 1e-12;
    };
    double flat = std::hypot(px - ax, py - ay);
    if (px > .375) {
      const bool left = below(ax, ay, px, py, .375);
      const bool right = px > .625 - 1e-12 && below(ax, ay, px, py, .625);
      if (left || right) {
        const double one = std::hypot(.375 - ax, .75 - ay), two = std::hypot(px - .625, py - .75);
        if (px < .625 - 1e-12 || !below(.375, .75, px, py, .625)) {
          flat = one + std::hypot(px - .375, py - .75);
        } else if (!below(ax, ay, .625, .75, .375)) {
          flat = std::hypot(.625 - ax, .75 - ay) + two;
        } else {
          flat = one + .25 + two;
        }
      }
    }
    d.push_back(over(flat, p[2] - a[2]));
  }
  return d;
}

}  // namespace plexway::testing
