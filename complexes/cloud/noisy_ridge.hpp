#pragma once

#include <span>
#include <vector>

#include "complexes/cloud/umbrella.hpp"

namespace plexway {

/// What a noisy cloud says of the ridge between two neighbours.
struct NoisyRidge {
  double way = 0;    ///< from one to the other over it, both moved into the planes of their sides
  double sharp = 0;  ///< 0: rounded, or there is none; 1: planes meet
  double off = 0;    ///< how far they are from these planes at most, in spacings
};

/// Ridges of a noisy cloud, by the many places of either side: heights of single ones are noise.
///
/// A ridge is sharp where nearly all normals around are those of one side or the other. Where a
/// surface is bent they lie between, or go on turning. Sides are planes through all their places
/// within two rings and three spacings, so they are nearly the same for all edges of a ridge:
/// lengths of needles that do not go with each other make short cuts.
class NoisyRidges {
 public:
  NoisyRidges(const Places& places, std::span<const TangentFrame> frames);

  /// The ridge between places i and j, if planes make more than 25 degrees and the way over it is
  /// at most `farthest` spacings. Cost: some 50 places for each of the two, once.
  [[nodiscard]] NoisyRidge between(Index i, Index j, double farthest);

 private:
  struct Side {
    Point3 normal{};
    Point3 middle{};    // of its places, from the one that it is the side of
    double height = 0;  // of the plane over that place
    bool known = false;
  };
  const Side& side_of(Index i);
  // How far the normals around two places are from those of two sides, in the mean, as a share of
  // the angle between these.
  [[nodiscard]] double share_between(Index i, Index j, const Point3& m, const Point3& n) const;

  const Places& places_;
  std::span<const TangentFrame> frames_;
  std::vector<Side> sides_;
  std::vector<Index> seen_;
};

}  // namespace plexway
