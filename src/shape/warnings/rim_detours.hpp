#pragma once

#include <array>
#include <cstddef>
#include <span>

namespace plexway {

/// Points of a cloud that came out farther than straight where the cloud is flat.
struct RimDetours {
  std::size_t points = 0;
  std::size_t first = 0;  ///< the lowest of them
  double most = 0;        ///< the largest share by which one is farther
  bool all = true;        ///< else there may be more
};

/// Those three to 25 spacings from a source and a twentieth to a half farther than straight, where
/// all that lies near the straight line lies in one plane with it: the way goes around a notch in
/// the rim, or a void. Whether the surface ends there only who has it can tell. What is farther yet
/// is behind a wall. Up to 16 sources are looked at, and none among more than 10,000 points (where
/// the cloud is so much denser than in the mean, its spacing is not what is asked for), nor one
/// whose neighbours lie in a line. Cost: for each a look at all points, and at those around it for
/// each of up to 64 that are farther, evenly among them if there are more.
[[nodiscard]] RimDetours rim_detours(std::span<const std::array<double, 3>> positions,
                                     double spacing, std::span<const double> distance,
                                     std::span<const std::size_t> sources);

}  // namespace plexway
