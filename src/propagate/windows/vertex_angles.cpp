#include "propagate/windows/vertex_angles.hpp"

#include <cmath>
#include <limits>
#include <numbers>

namespace plexway::windows {

double VertexAngles::excess(Index vertex) const {
  switch (kind[vertex]) {
    case inner:
      return total[vertex] - 2 * std::numbers::pi;
    case boundary:
      return total[vertex] - std::numbers::pi;
    default:
      return std::numeric_limits<double>::infinity();
  }
}

template <class Real>
VertexAngles vertex_angles(const TriangleMesh<Real>& mesh) {
  VertexAngles angles;
  angles.total.assign(mesh.vertex_count(), 0);
  angles.kind.assign(mesh.vertex_count(), VertexAngles::inner);
  const auto triangles = mesh.triangles();
  const Index sentinel = static_cast<Index>(mesh.face_count());
  for (Index f = 0; f < sentinel; ++f) {
    const TriangleRecord<Real>& t = triangles[f];
    for (std::size_t i = 0; i < 3; ++i) {
      angles.total[t.corner[i]] +=
          std::atan2(static_cast<double>(t.sine(i)), static_cast<double>(t.cosine[i]));
      const bool open = t.across[i] >> Across::face_shift == sentinel;
      const bool fan = (t.across[i] & Across::fan) != 0;
      if (!open && !fan) continue;
      for (const Index v : {t.corner[i], t.corner[edge_after(i)]}) {
        VertexAngles::Kind& kind = angles.kind[v];
        if (fan)
          kind = VertexAngles::irregular;
        else if (kind == VertexAngles::inner)
          kind = VertexAngles::boundary;
      }
    }
  }
  for (const Index v : mesh.pinched()) angles.kind[v] = VertexAngles::irregular;
  return angles;
}

template VertexAngles vertex_angles(const TriangleMesh<float>&);
template VertexAngles vertex_angles(const TriangleMesh<double>&);

}  // namespace plexway::windows
