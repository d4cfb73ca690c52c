#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <utility>
#include <vector>

#include <plexway/common/ids.hpp>

#include "strings/place.hpp"

namespace plexway::detail {

/// Straight lines through simplices, in double. Space has
///   corners(s)           the points of a simplex, none beyond
///   point(p)             where it is
///   may_cross(s)         may lines run through it?
///   around(s, weights)   all simplices that have a point of s
template <class Space>
class StraightWalk {
 public:
  using Point = strings::Point;
  using Weights = std::array<double, 4>;

  explicit StraightWalk(Space space) : space_(std::move(space)) {}

  /// One a corner of the simplex; of a point beside it those of the nearest one in its plane or
  /// line.
  [[nodiscard]] Weights weights(Index simplex, const Point& p) const {
    const std::array<Index, 4> c = space_.corners(simplex);
    const Point origin = space_.point(c[0]), off = p - origin, u = space_.point(c[1]) - origin;
    Weights w = {};
    if (c[2] == none) {
      w[1] = dot(off, u) / dot(u, u);
    } else {
      const Point v = space_.point(c[2]) - origin;
      const Point last = c[3] == none ? cross(u, v) : space_.point(c[3]) - origin;
      const double volume = dot(last, cross(u, v));
      w[1] = dot(off, cross(v, last)) / volume;
      w[2] = dot(off, cross(last, u)) / volume;
      if (c[3] != none) w[3] = dot(off, cross(u, v)) / volume;
    }
    w[0] = 1 - w[1] - w[2] - w[3];
    return w;
  }

  /// A part of a line, from `begin` to `end` of its length, in one simplex.
  struct Step {
    Index simplex;
    double begin, end;
  };
  /// From p, which lies in one of `from`, straight to q. Lines may be off by 1e-9 of a simplex; by
  /// more, to 1e-2, where they do not arrive else. Each step gets on, so it ends. False if it did
  /// not arrive. Cost: linear in the simplices at what it crosses.
  bool walk(const std::vector<Index>& from, const Point& p, const Point& q,
            std::vector<Step>& steps) const {
    constexpr double finest = 1e-9, coarsest = 1e-2;
    for (double tolerance = finest; tolerance < coarsest; tolerance *= 10)
      if (arrives(from, p, q, tolerance, steps)) return true;
    return arrives(from, p, q, coarsest, steps);
  }

  /// All simplices that have this point of one.
  [[nodiscard]] std::vector<Index> around(Index simplex, const Point& p) const {
    constexpr double near = 1e-7;
    Weights w = weights(simplex, p);
    for (double& x : w)
      if (x < near) x = 0;
    return space_.around(simplex, w);
  }

 private:
  bool arrives(std::vector<Index> now, const Point& p, const Point& q, double tolerance,
               std::vector<Step>& steps) const {
    constexpr double progress = 1e-12;
    steps.clear();
    for (double at = 0; at < 1;) {
      Step best = {none, at, at + progress};
      for (const Index s : now) {
        if (!space_.may_cross(s)) continue;
        const double until = leaves(s, p, q, at, tolerance);
        if (until > best.end) best = {s, at, until};
      }
      if (best.simplex == none) return false;
      steps.push_back(best);
      at = best.end;
      if (at < 1) now = around(best.simplex, p + at * (q - p));
    }
    return true;
  }

  // Up to where does the line stay in a simplex that it is in at `at`? -1: it is not.
  [[nodiscard]] double leaves(Index simplex, const Point& p, const Point& q, double at,
                              double tolerance) const {
    const Weights from = weights(simplex, p), to = weights(simplex, q);
    double first = 1;
    for (std::size_t i = 0; i < 4; ++i) {
      if (!(from[i] + at * (to[i] - from[i]) >= -tolerance)) return -1;
      if (to[i] < -tolerance) first = std::min(first, from[i] / (from[i] - to[i]));
    }
    return first;
  }

  Space space_;
};

}  // namespace plexway::detail
