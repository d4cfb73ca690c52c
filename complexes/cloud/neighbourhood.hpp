#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include <plexway/cloud/neighbours.hpp>

namespace plexway::detail {

/// Throws InputError for a coordinate that is not finite, or lists that are not of these points.
void check(std::span<const std::array<double, 3>> points, const Neighbours& neighbours);

/// The points around one point, as offsets from it.
struct Neighbourhood {
  std::vector<std::array<double, 3>> offset;
  std::vector<double> weight;  ///< 1 at the point, falling with the square of the distance
  double radius = 0;           ///< of the farthest
  double mean_square = 0;      ///< of the distances

  /// The neighbours alone.
  void set_neighbours(std::span<const std::array<double, 3>> points, const Neighbours& neighbours,
                      Index centre);

  /// The neighbours and theirs, each once; where there are many, the first some hundred. Enough
  /// neighbours stay by themselves.
  void set_two_rings(std::span<const std::array<double, 3>> points, const Neighbours& neighbours,
                     Index centre);

  /// Forgets all but the first so many neighbours.
  void keep_nearest(std::size_t count);

 private:
  static constexpr std::size_t enough = 64, slots = 1024, most = slots / 2;
  bool add(Index point);
  void place(std::span<const std::array<double, 3>> points, Index centre);
  void measure();

  std::vector<Index> members_;
  std::array<Index, slots> table_;  // which points are there, by their numbers' low bits
};

}  // namespace plexway::detail
