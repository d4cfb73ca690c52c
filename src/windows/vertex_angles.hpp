#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include <plexway/surface/triangle_mesh.hpp>

namespace plexway::detail::windows {

/// How much room there is around each vertex, in the numbers inside.
struct VertexAngles {
  enum Kind : std::uint8_t {
    inner,      ///< one closed fan
    boundary,   ///< one open fan
    irregular,  ///< several fans, or an edge with more than two triangles
  };

  /// What a vertex has more than lets shortest paths pass straight, radians: above 2 pi inside,
  /// above pi on a boundary. +inf where paths may bend at any angle: where sheets meet, and where a
  /// boundary turns by more than rounding, since a sliver behind it may be reached along its edge
  /// alone.
  std::vector<float> excess;
  std::vector<Kind> kind;

  [[nodiscard]] std::size_t bytes() const {
    return excess.capacity() * sizeof(excess[0]) + kind.capacity() * sizeof(kind[0]);
  }
};

/// Cost: one arc tangent a corner.
template <class Real>
VertexAngles vertex_angles(const TriangleMesh<Real>& mesh);

}  // namespace plexway::detail::windows
