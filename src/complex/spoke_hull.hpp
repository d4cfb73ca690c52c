#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include <plexway/complex/ids.hpp>

namespace plexway {

/// A neighbour in the tangent plane of a place, and its image in the circle around the place.
struct Spoke {
  double x, y, u, v;
  Index place;
};

/// The hull of the images of a place's neighbours: the Delaunay umbrella of the place.
class SpokeHull {
 public:
  /// Numbers of spokes, counterclockwise from the nearest neighbour; none where rounding leaves no
  /// way around. Places on one circle are dealt with in the same way from all of them. Valid until
  /// the next call.
  std::span<const std::size_t> wrap(Index place, std::span<const Spoke> spokes);

 private:
  bool wrap_without_ties(std::size_t first, double largest);
  std::size_t next_of_ties(Index place, std::size_t at);
  std::size_t break_ties(Index place, std::size_t at, std::size_t best);

  std::span<const Spoke> spokes_;
  std::vector<std::size_t> hull_, ties_;
};

}  // namespace plexway
