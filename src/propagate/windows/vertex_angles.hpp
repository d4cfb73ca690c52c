#pragma once

#include <cstdint>
#include <vector>

#include <plexway/complex/triangle_mesh.hpp>

namespace plexway::windows {

/// How much room there is around each vertex, in the numbers inside.
struct VertexAngles {
  enum Kind : std::uint8_t {
    inner,      ///< one closed fan
    boundary,   ///< one open fan
    irregular,  ///< several fans, or an edge with more than two triangles
  };

  std::vector<double> total;  ///< the angles at a vertex in sum, radians
  std::vector<Kind> kind;

  /// What a vertex has more than lets shortest paths pass straight: above 2 pi inside, above pi on
  /// a boundary. Where sheets meet paths may always bend.
  [[nodiscard]] double excess(Index vertex) const;
};

/// Cost: one arc tangent a corner.
template <class Real>
VertexAngles vertex_angles(const TriangleMesh<Real>& mesh);

}  // namespace plexway::windows
