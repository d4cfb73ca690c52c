#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include <plexway/common/ids.hpp>

#include "complexes/common/point3.hpp"

namespace plexway::detail {

/// A neighbour in the tangent plane of a place, and its image in the circle around the place.
struct Spoke {
  double x, y, u, v;
  Index place;
};

/// The hull of the images of a place's neighbours: the Delaunay umbrella of the place.
class SpokeHull {
 public:
  SpokeHull() = default;
  /// Where all places are in space: so that the places of a circle agree that it is one, though
  /// each sees it in a tangent plane of its own.
  explicit SpokeHull(std::span<const Point3> at) : at_(at) {}

  /// Numbers of spokes, counterclockwise from the nearest neighbour; none where rounding leaves no
  /// way around. Places on one circle are dealt with in the same way from all of them. Valid until
  /// the next call.
  std::span<const std::size_t> wrap(Index place, std::span<const Spoke> spokes);

 private:
  bool wrap_without_ties(std::size_t first, double largest);
  std::size_t next_of_ties(Index place, std::size_t at);
  std::size_t break_ties(Index place, std::size_t at, std::size_t best);
  [[nodiscard]] bool on_one_circle(std::array<Index, 4> places) const;

  std::span<const Point3> at_;

  std::span<const Spoke> spokes_;
  std::vector<std::size_t> hull_, ties_;
};

}  // namespace plexway::detail
