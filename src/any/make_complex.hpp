#pragma once

#include <type_traits>

#include <plexway/complex/point_cloud.hpp>
#include <plexway/complex/tet_mesh.hpp>
#include <plexway/complex/triangle_mesh.hpp>
#include <plexway/complex/wireframe.hpp>
#include <plexway/io/edges.hpp>
#include <plexway/io/tets.hpp>
#include <plexway/io/triangles.hpp>

#include "cloud.hpp"
#include "metric_options.hpp"

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

// The same measured by a metric, where `lengths` is not null.
template <class Real, class Shape>
auto make_complex(const Shape& shape, [[maybe_unused]] const MeasuredLengths* lengths)
    -> decltype(make_complex<Real>(shape)) {
  if (lengths == nullptr) return make_complex<Real>(shape);
  if constexpr (std::is_same_v<Shape, io::Triangles>) {
    SurfaceHints hints;
    hints.refracts = lengths->refracts;
    return {shape.positions.size(), shape.triangles, lengths->triangles, hints};
  } else if constexpr (std::is_same_v<Shape, io::Tets>) {
    return {shape.positions.size(), shape.tets, lengths->tets};
  } else if constexpr (std::is_same_v<Shape, io::Edges>) {
    return {shape.vertices, shape.edges, lengths->edges};
  } else {
    return make_complex<Real>(shape);
  }
}

}  // namespace plexway::cli
