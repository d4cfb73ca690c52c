#pragma once

#include <array>
#include <cstdint>
#include <unordered_map>
#include <vector>

#include "bricks.hpp"

namespace plexway::openvdb {

/// The body-centred cubic lattice around the inside of a level set, in bricks of 8 x 8 x 8 cells.
///
/// Of each cell it has two points: the corner (x, y, z) and the centre. In doubled coordinates
/// these are all even or all odd, and the 14 neighbours of a point are 2 away along an axis (a long
/// edge) or 1 along all three (a short one, of sqrt(3)/2 the length).
class Lattice {
 public:
  using Point = std::uint32_t;  ///< 1024 a brick: 512 corners, then 512 centres
  static constexpr Point none = ~Point{0};
  static constexpr std::size_t directions = 14;
  /// Steps in doubled coordinates: the long ones are 8 to 13; direction d has its opposite at d ^ 7
  /// among the short ones and d ^ 1 among the long ones.
  static const std::array<Cell, directions> steps;

  /// Points are `spacing` voxels apart. Throws InputError where there are too many of them.
  Lattice(const Bricks& bricks, double spacing);

  [[nodiscard]] std::size_t bricks() const { return numbers_.size(); }
  [[nodiscard]] Point points() const { return static_cast<Point>(1024 * bricks()); }

  /// Bricks beside a brick, itself in the middle.
  using Around = std::array<std::uint32_t, 27>;
  [[nodiscard]] Around around(std::uint32_t brick) const;
  /// The point at these doubled coordinates, counted from the corner of the brick in the middle;
  /// from -16 to 31. `none` where there is no brick.
  static Point at(const Around& around, std::int32_t x, std::int32_t y, std::int32_t z) {
    const std::int32_t i = x >> 1, j = y >> 1, k = z >> 1;
    const auto beside =
        static_cast<std::size_t>(9 * ((i >> 3) + 1) + 3 * ((j >> 3) + 1) + ((k >> 3) + 1));
    const std::uint32_t brick = around[beside];
    if (brick == BrickNumbers::none) return none;
    const std::size_t local = Bricks::offset(i, j, k) + ((x & 1) != 0 ? 512u : 0u);
    return brick << 10 | static_cast<Point>(local);
  }
  /// Doubled coordinates of point `local` (below 1024) of any brick, from the brick's corner.
  static Cell doubled(std::uint32_t local) {
    const auto at = [&](unsigned shift) {
      return static_cast<std::int32_t>(2 * (local >> shift & 7) + (local >> 9));
    };
    return {at(6), at(3), at(0)};
  }

  /// -1 inside, 0 on the surface, 1 outside.
  [[nodiscard]] int side(Point p) const { return side_[p]; }
  /// Whether all points of a brick and of those around it lie inside.
  [[nodiscard]] bool deep(const Around& around) const;

  /// Where the point is, in voxels: on the surface if it was moved there.
  [[nodiscard]] Vector place(Point p) const;
  /// Where the surface crosses the edge in that direction from a point inside to one outside.
  [[nodiscard]] Vector crossing(Point inside, std::size_t direction) const;

 private:
  void choose_bricks(const Bricks& bricks);
  void evaluate(const Bricks& bricks);
  void move_near_points();
  [[nodiscard]] Vector at_rest(Point p) const;
  [[nodiscard]] double share_to_crossing(Point inside, Point outside, const Vector& a,
                                         const Vector& b) const;

  const Bricks& level_set_;
  double spacing_;
  BrickNumbers numbers_;
  std::vector<float> value_;
  std::vector<std::int8_t> side_;
  std::vector<char> all_inside_;  ///< of a brick
  std::unordered_map<Point, Vector> moved_;
};

}  // namespace plexway::openvdb
