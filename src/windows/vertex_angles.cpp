#include "windows/vertex_angles.hpp"

#include <cmath>
#include <numbers>

#include "complexes/common/number_range.hpp"

namespace plexway::detail::windows {
namespace {

/// Boundaries that turn by more than this bend paths, radians.
constexpr double least_bend = 2e-6;

double excess(double total, VertexAngles::Kind kind) {
  if (kind == VertexAngles::irregular) return infinity;
  if (kind == VertexAngles::inner) return total - 2 * std::numbers::pi;
  const double bend = total - std::numbers::pi;
  return bend > least_bend ? infinity : bend;
}

}  // namespace

template <class Real>
VertexAngles vertex_angles(const TriangleMesh<Real>& mesh) {
  VertexAngles angles;
  std::vector<double> total(mesh.vertex_count(), 0);
  angles.kind.assign(mesh.vertex_count(), VertexAngles::inner);
  const auto triangles = mesh.triangles();
  const Index sentinel = static_cast<Index>(mesh.face_count());
  for (Index f = 0; f < sentinel; ++f) {
    const TriangleRecord<Real>& t = triangles[f];
    for (std::size_t i = 0; i < 3; ++i) {
      total[t.corner[i]] +=
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
  angles.excess.resize(mesh.vertex_count());
  for (Index v = 0; v < mesh.vertex_count(); ++v)
    angles.excess[v] = static_cast<float>(excess(total[v], angles.kind[v]));
  return angles;
}

template VertexAngles vertex_angles(const TriangleMesh<float>&);
template VertexAngles vertex_angles(const TriangleMesh<double>&);

}  // namespace plexway::detail::windows
