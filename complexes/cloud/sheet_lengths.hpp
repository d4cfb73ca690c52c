#pragma once

#include <array>
#include <span>
#include <vector>

#include "complexes/cloud/umbrella.hpp"

namespace plexway::detail {

/// How long the edges of a cloud's triangles are, 0 1, 1 2 and 2 0 of each: over creases, in a
/// cloud with `noise` (spacings) over all ridges where planes meet, and without a share `flat` of
/// what is taken for noise (`tangent_length`). None if all are as in space.
std::vector<std::array<double, 3>> sheet_lengths(const Places& places,
                                                 std::span<const TangentFrame> frames,
                                                 const SheetRule& rule,
                                                 std::span<const std::array<Index, 3>> faces,
                                                 double flat, double noise);

/// The places, ascending, with edges that lead from one side of a ridge to the other and are far
/// shorter than the way over it, where so much `height` between neighbours (spacings) may be noise;
/// in a cloud with `noise` those that are on neither side of a ridge as well.
[[nodiscard]] std::vector<Index> chord_places(const Places& places,
                                              std::span<const TangentFrame> frames,
                                              const SheetRule& rule,
                                              std::span<const std::array<Index, 3>> faces,
                                              std::span<const std::array<double, 3>> lengths,
                                              double height, double noise);

/// Heights of neighbours over each other, along the mean normal of both.
///
/// On a smooth surface an edge leaves both tangent planes to the same side, and nothing is left
/// along the mean normal but what curvature and chance in the normals make, which grows with the
/// edge. Noise is as high on short edges as on long ones.
struct HeightNoise {
  double share = 0;   ///< how much of the heights is noise, 0 to 1
  double height = 0;  ///< of noise between two neighbours, its median; 0 if there is none
};

/// By the medians of near and of far neighbours of some thousand places.
HeightNoise height_noise(const Places& places, std::span<const TangentFrame> frames);

/// Length of an edge, without `share` of the square of its height. Normals that differ by more than
/// 25 degrees tell nothing, as across an edge of a solid: the length is that in space.
double tangent_length(const Places& places, std::span<const TangentFrame> frames, Index a, Index b,
                      double share);

}  // namespace plexway::detail
