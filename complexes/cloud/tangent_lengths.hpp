#pragma once

#include <span>

#include "complexes/cloud/umbrella.hpp"

namespace plexway {

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

}  // namespace plexway
