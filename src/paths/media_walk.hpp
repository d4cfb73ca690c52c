#pragma once

#include <array>
#include <span>
#include <vector>

#include "strings/media_space.hpp"

namespace plexway {

/// Straight lines through the simplices of a medium.
class MediaWalk {
 public:
  using Point = strings::Point;
  using Weights = std::array<double, 4>;

  explicit MediaWalk(const strings::MediaSpace& space) : space_(space) {}

  /// One a corner of the simplex; of a point beside it those of the nearest one in its plane or
  /// line.
  [[nodiscard]] Weights weights(Index simplex, const Point& p) const;

  /// A part of a line, from `begin` to `end` of its length, in one simplex.
  struct Step {
    Index simplex;
    double begin, end;
  };
  /// From p, which lies in one of `from`, straight to q. Lines may be off by 1e-9 of a simplex; by
  /// more, to 1e-2, where they do not arrive else. False if it did not arrive.
  /// Cost: linear in the simplices at what it crosses.
  bool walk(Index medium, std::vector<Index> from, const Point& p, const Point& q,
            std::vector<Step>& steps) const;
  /// All simplices, of any medium, that have a point of this one.
  [[nodiscard]] std::vector<Index> around(Index simplex, const Point& p) const;

 private:
  [[nodiscard]] bool is_of(Index simplex, Index medium) const;
  [[nodiscard]] double leaves(Index simplex, const Point& p, const Point& q, double at,
                              double tolerance) const;

  const strings::MediaSpace& space_;
};

}  // namespace plexway
