#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <string>
#include <string_view>

#include <plexway/error.hpp>
#include <plexway/io/triangles.hpp>

namespace plexway::io {

/// The last 32-bit number is left free for "none".
inline constexpr std::uint64_t most_vertices = std::numeric_limits<std::uint32_t>::max();

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
