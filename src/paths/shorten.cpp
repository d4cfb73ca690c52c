#include <plexway/paths/shorten.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>
#include <vector>

#include <plexway/error.hpp>
#include <plexway/source/point_source.hpp>

#include "complexes/common/arrays.hpp"
#include "paths/strip_paths.hpp"

namespace plexway {
using namespace detail;

template <class Real>
Path shortened(const TriangleMesh<Real>& mesh, std::span<const PathPoint> path,
               const GivenPoints& positions) {
  if (mesh.metric() == MetricKind::refracting)
    throw UsageError("a given path is not shortened on surfaces with refracting edges");
  if (path.empty()) throw UsageError("there is no path to shorten: it has no points");
  if (!positions.empty() && positions.size() != mesh.vertex_count())
    throw UsageError("expected one position a vertex");
  const std::vector<Index> outer = vertices_outside(mesh);
  const auto at = [&](const PathPoint& point) {
    const auto [face, runs_back] = mesh.inside_face(point.simplex);
    const auto& b = point.barycentric;
    if (face == none || !(b[0] >= 0 && b[1] >= 0 && b[2] >= 0) ||
        !(std::abs(b[0] + b[1] + b[2] - 1) < 1e-6))
      throw UsageError("a point of the path is not in the surface");
    return StraightPiece{face, turned({b[0], b[1], b[2]}, runs_back), {}};
  };
  std::vector<StraightPiece> lines;
  for (std::size_t i = 0; i + 1 < path.size(); ++i) {
    StraightPiece line = at(path[i]);
    const StraightPiece next = at(path[i + 1]);
    const auto& corner = mesh.triangles()[line.face].corner;
    for (std::size_t k = 0; k < 3; ++k) {
      if (next.from[k] == 0) continue;
      const Index vertex = mesh.triangles()[next.face].corner[k];
      const auto own =
          next.face == line.face
              ? k
              : static_cast<std::size_t>(std::find(corner, corner + 3, vertex) - corner);
      if (own == 3)
        throw UsageError("points " + std::to_string(i) + " and " + std::to_string(i + 1) +
                         " of the path are in no common triangle");
      line.to[own] += next.from[k];
    }
    lines.push_back(line);
  }
  if (lines.empty()) {  // it stays where it is
    const StraightPiece only = at(path[0]);
    lines.push_back({only.face, only.from, only.from});
  }
  const auto end = [](const PathPoint& point) {
    return PointSource{.simplex = point.simplex, .barycentric = point.barycentric};
  };
  return LaidPaths<Real>(mesh, positions, outer).lay(lines, end(path.front()), end(path.back()));
}

template Path shortened(const TriangleMesh<float>&, std::span<const PathPoint>, const GivenPoints&);
template Path shortened(const TriangleMesh<double>&, std::span<const PathPoint>,
                        const GivenPoints&);

}  // namespace plexway
