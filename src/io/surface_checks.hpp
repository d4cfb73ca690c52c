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

/// What is wrong with a face that names a vertex the file does not have. Faces count from 0.
inline std::string bad_index(std::size_t face, std::int64_t index, std::size_t vertices) {
  return "face " + std::to_string(face) + " names vertex " + std::to_string(index) +
         ", but the file has " + std::to_string(vertices) + " vertices";
}

inline std::string too_few_corners(std::size_t face, std::size_t corners) {
  return "face " + std::to_string(face) + " has " + std::to_string(corners) +
         (corners == 1 ? " corner" : " corners") + "; it needs at least 3";
}

inline void require_faces(const Triangles& surface, std::string_view name) {
  if (surface.triangles.empty())
    throw InputError(std::string(name) + ": has no faces; a surface needs at least one triangle");
}

/// Cuts a polygon into a fan around its first corner while its corners come in one by one.
class Fan {
 public:
  explicit Fan(Triangles& surface) : surface_(surface) {}

  void corner(std::uint32_t vertex) {
    if (corners_ == 0)
      first_ = vertex;
    else if (corners_ >= 2)
      surface_.triangles.push_back({first_, previous_, vertex});
    previous_ = vertex;
    ++corners_;
  }

  std::size_t corners() const { return corners_; }

 private:
  Triangles& surface_;
  std::uint32_t first_ = 0;
  std::uint32_t previous_ = 0;
  std::size_t corners_ = 0;
};

}  // namespace plexway::io
