#pragma once

#include <cmath>
#include <optional>
#include <span>
#include <vector>

#include "complexes/cloud/umbrella.hpp"

namespace plexway::detail {

/// Where a sharp edge runs between two places whose normals differ: along the line in which their
/// tangent planes meet.
struct Crease {
  Point3 along;   ///< the line's direction, unit
  Point3 across;  ///< in the tangent plane of the first place, unit, towards the line
  double here;    ///< from the first place to the line, >= 0
  double there;   ///< from the line to the second place, >= 0
};

/// Can there be one, by the cosine of the angle between two normals? Planes that are nearly
/// parallel meet anywhere.
inline bool may_crease(double cosine) { return cosine * cosine <= 1 - 0.3 * 0.3; }

/// The crease between two neighbours, if their normals say that there is one and both are near it:
/// within `farthest` spacings of each other by way of it. Normals that do not tell inside from
/// outside are as near to each other at a ridge of 30 degrees as at a bend of 30: there is a crease
/// where both planes end at the line and lie on the same side of it.
///
/// Around a crease the surface is unfolded: then a tangent plane goes on in the one beyond, and
/// what is flat on both sides is flat. Orthogonal projection lays all that is beyond a right angle
/// on one line.
std::optional<Crease> crease_between(const Places& places, std::span<const TangentFrame> frames,
                                     const SheetRule& rule, Index i, Index j, double farthest = 4);

/// How long the way from i to j is, by their places in space and, as far as the crease between them
/// is sharp, over it. Sharp is what lies between planes: where the surface is only bent more than
/// its points can tell, the way over the line in which tangent planes meet is too long.
double length_over(const Crease& crease, const Places& places, std::span<const TangentFrame> frames,
                   Index i, Index j);

/// The way from i to j over the line where their planes meet, if they lie like the two sides of a
/// ridge, within four spacings of each other by way of it, though less clearly than at a crease: by
/// so much `noise` (spacings). Else 0. Without noise a ridge of more than 60 degrees that is no
/// sharp crease is rounded, and nothing is wrong.
double way_over_ridge(const Places& places, std::span<const TangentFrame> frames,
                      const SheetRule& rule, Index i, Index j, double noise);

/// Is each of two places, which are q apart, in the tangent plane of the other, nearly?
inline bool in_both_planes(const TangentFrame& a, const TangentFrame& b, const SheetRule& rule,
                           const Point3& q) {
  const auto fits = [&](const TangentFrame& f) {
    return std::abs(dot(f.normal, q)) <= rule.most_offset * static_cast<double>(f.spacing);
  };
  return fits(a) && fits(b);
}

/// Are two neighbours on the same sheet, by the tangent planes of both, or beside the same crease?
inline bool same_sheet(const Places& places, std::span<const TangentFrame> frames,
                       const SheetRule& rule, Index i, Index j) {
  const TangentFrame &a = frames[i], &b = frames[j];
  const double cosine = dot(a.normal, b.normal);
  const bool beside = may_crease(cosine) && crease_between(places, frames, rule, i, j);
  if (beside || (rule.oriented ? cosine : std::abs(cosine)) < rule.least_cosine) return beside;
  return in_both_planes(a, b, rule, minus(places.at[j], places.at[i]));
}

/// The offset of neighbour j from i, unfolded about the crease between them, if there is one.
Point3 over_crease(const Places& places, std::span<const TangentFrame> frames,
                   const SheetRule& rule, Index i, Index j);

/// Neighbour j as i sees it: the offset in space, or the one unfolded about the crease between.
inline Point3 unfolded(const Places& places, std::span<const TangentFrame> frames,
                       const SheetRule& rule, Index i, Index j) {
  if (i < frames.size() && j < frames.size() && may_crease(dot(frames[i].normal, frames[j].normal)))
    return over_crease(places, frames, rule, i, j);
  return minus(places.at[j], places.at[i]);
}

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

}  // namespace plexway::detail
