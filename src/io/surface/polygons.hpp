#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <plexway/error.hpp>
#include <plexway/io/triangles.hpp>

namespace plexway::io {

/// Cuts a polygon into triangles of its corners and appends them: one of four corners along the
/// shorter diagonal that lies inside, a convex one as a fan about its first corner, any other by
/// clipping ears. It may be bent a little, and touch itself where a hole is joined to the rim. Of
/// corners that follow each other and are the same vertex one counts; where fewer than three are
/// left, the one triangle has a vertex twice.
void cut_polygon(std::span<const std::array<double, 3>> positions,
                 std::span<const std::uint32_t> corners,
                 std::vector<std::array<std::uint32_t, 3>>& triangles);

/// Takes faces corner by corner. Vertices may come after them, so polygons of more than three
/// corners are fans at first, and cut once all positions are known.
class Faces {
 public:
  explicit Faces(std::vector<std::array<std::uint32_t, 3>>& triangles) : triangles_(triangles) {}

  void corner(std::uint32_t vertex) {
    if (corners_ == 0)
      first_ = vertex;
    else if (corners_ >= 2)
      triangles_.push_back({first_, previous_, vertex});
    previous_ = vertex;
    ++corners_;
  }
  /// How many corners the face has so far.
  [[nodiscard]] std::size_t corners() const { return corners_; }
  void end_face() {
    if (corners_ > 3) polygons_.push_back({triangles_.size() - (corners_ - 2), corners_});
    corners_ = 0;
  }
  /// Cuts the polygons, and returns how many there are.
  std::size_t cut(std::span<const std::array<double, 3>> positions);

 private:
  struct Polygon {
    std::size_t first;  ///< of the triangles of its fan
    std::size_t corners;
  };
  std::vector<std::array<std::uint32_t, 3>>& triangles_;
  std::vector<Polygon> polygons_;
  std::uint32_t first_ = 0, previous_ = 0;
  std::size_t corners_ = 0;
};

/// The last 32-bit number is left free for "none".
inline constexpr std::uint64_t most_vertices = std::numeric_limits<std::uint32_t>::max();

/// No file of so many bytes is worth more points or cells than this. One that repeats its parts
/// more often, or that names a higher vertex, is not what it seems.
constexpr std::uint64_t most_elements(std::uint64_t bytes) {
  return std::min(most_vertices, (std::uint64_t{1} << 24) + 64 * bytes);
}

/// What is wrong with a cell that names a vertex the file does not have. Both as the file counts.
inline std::string bad_corner(std::string_view cell, std::int64_t number, std::int64_t vertex,
                              std::size_t vertices) {
  return std::string(cell) + " " + std::to_string(number) + " names vertex " +
         std::to_string(vertex) + ", but the file has " + std::to_string(vertices) + " vertices";
}

inline std::string too_few_corners(std::size_t face, std::size_t corners) {
  return "face " + std::to_string(face) + " has " + std::to_string(corners) +
         (corners == 1 ? " corner" : " corners") + "; it needs at least 3";
}

inline void require_faces(const Triangles& surface, std::string_view name) {
  if (surface.triangles.empty())
    throw InputError(std::string(name) + ": has no faces; a surface needs at least one triangle");
}

}  // namespace plexway::io
