#pragma once

#include <array>
#include <span>
#include <vector>

#include "complexes/cloud/umbrella.hpp"

namespace plexway {

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

}  // namespace plexway
