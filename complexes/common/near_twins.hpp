#pragma once

#include <array>
#include <span>

#include <plexway/cloud/neighbours.hpp>

namespace plexway {

/// May without_near_twins find any? Of points of which no two are at one place; for those that lie
/// beside their neighbours in memory it is much quicker.
[[nodiscard]] bool may_have_near_twins(std::span<const std::array<double, 3>> points,
                                       const Neighbours& neighbours);

}  // namespace plexway
