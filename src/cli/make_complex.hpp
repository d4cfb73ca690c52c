#pragma once

#include <plexway/complex/point_cloud.hpp>
#include <plexway/complex/tet_mesh.hpp>
#include <plexway/complex/triangle_mesh.hpp>
#include <plexway/complex/wireframe.hpp>
#include <plexway/io/edges.hpp>
#include <plexway/io/tets.hpp>
#include <plexway/io/triangles.hpp>

#include "cloud.hpp"

namespace plexway::cli {

// The complex of each kind of shape that a Domain holds. Each is built in place: complexes are not
// to be copied.
template <class Real>
TriangleMesh<Real> make_complex(const io::Triangles& surface) {
  return {surface.positions, surface.triangles};
}
template <class Real>
TetMesh<Real> make_complex(const io::Tets& solid) {
  return {solid.positions, solid.tets};
}
template <class Real>
Wireframe<Real> make_complex(const io::Edges& wireframe) {
  if (wireframe.lengths.empty()) return {wireframe.positions, wireframe.edges};
  return {wireframe.vertices, wireframe.edges, wireframe.lengths};
}
template <class Real>
PointCloud<Real> make_complex(const Cloud& cloud) {
  return {cloud.measured(), cloud.neighbours, cloud_options(cloud)};
}

}  // namespace plexway::cli
