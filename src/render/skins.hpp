#pragma once

#include <optional>
#include <span>
#include <vector>

#include "cells.hpp"
#include "draw_list.hpp"

namespace plexway::render {

inline constexpr Colour part_grey = {214, 219, 226};
inline constexpr Colour unreached = {150, 150, 150};

/// Moves positions to a frame in which the scene is about 1 in size, around the origin.
struct Frame {
  Point centre{};
  double scale = 1;

  [[nodiscard]] Point operator()(const Point& p) const { return times(scale, minus(p, centre)); }
};

/// How the parts of a scene are turned into triangles.
struct Making {
  Frame frame;
  std::optional<Plane> clip;  ///< in the frame
  Point toward{};             ///< to the camera, unit
  double pixel = 0;           ///< about a pixel's size in the frame, at the scene's middle
};

/// Triangles of a part's positions with smooth normals, creases of more than 55 degrees kept.
/// `triangles` may be those of the part or others, such as the boundary of its tetrahedra.
void add_surface(Batch& batch, const Part& part, const Cells* cells,
                 std::span<const std::array<std::uint32_t, 3>> triangles, const Making& making);

/// The triangles of exactly one tetrahedron, facing outwards; not those in the clip plane, which
/// are the cap's.
std::vector<std::array<std::uint32_t, 3>> boundary(
    std::span<const Point> positions, std::span<const std::array<std::uint32_t, 4>> tets,
    const Making& making);

/// Where the clip plane cuts the tetrahedra: a polygon of each, values linear in it.
void add_cap(Batch& batch, const Part& part, const Cells* cells, const Making& making);

/// Where the value, linear in each tetrahedron, is `iso`.
void add_isosurface(Batch& batch, const Part& part, double iso, const Making& making);

}  // namespace plexway::render
