#pragma once

#include <functional>
#include <optional>

#include <plexway/any/field.hpp>
#include <plexway/any/shape.hpp>
#include <plexway/complex/intrinsic_delaunay.hpp>
#include <plexway/domain/domains.hpp>

namespace plexway {

constexpr Triangulation named(Retriangulation done) {
  return done == Retriangulation::keep    ? Triangulation::input
         : done == Retriangulation::flips ? Triangulation::delaunay
                                          : Triangulation::refined;
}

/// What a complex is made of.
struct Making {
  const AnyShape& shape;
  const MeasuredLengths* lengths = nullptr;  ///< by a metric, or those alone; null: in space
  std::function<bool(double)> progress = {};
};

// The complex of each kind of shape. Each is built in place: complexes are not to be copied.
template <class Real>
TriangleMesh<Real> make_complex(const io::Triangles& surface, const Making& making) {
  if (making.lengths == nullptr) return {surface.positions, surface.triangles};
  SurfaceHints hints;
  hints.refracts = making.lengths->refracts;
  return {making.shape.vertices(), surface.triangles, making.lengths->triangles, hints};
}
template <class Real>
TetMesh<Real> make_complex(const io::Tets& solid, const Making& making) {
  if (making.lengths == nullptr) return {solid.positions, solid.tets};
  return {making.shape.vertices(), solid.tets, making.lengths->tets};
}
template <class Real>
Wireframe<Real> make_complex(const io::Edges& wireframe, const Making& making) {
  if (making.lengths != nullptr)
    return {wireframe.vertices, wireframe.edges, making.lengths->edges};
  if (wireframe.lengths.empty()) return {wireframe.positions, wireframe.edges};
  return {wireframe.vertices, wireframe.edges, wireframe.lengths};
}
template <class Real>
PointCloud<Real> make_complex(const CloudShape& cloud, const Making& making) {
  CloudOptions options;
  if (cloud.max_normal_angle) options.max_normal_angle = *cloud.max_normal_angle;
  options.normals = cloud.normals();
  options.progress = making.progress;
  return {cloud.measured(), cloud.neighbours, options};
}

/// A surface on the triangles wanted, or if that is left open on those that pay; what comes with it
/// translates points.
template <class Real>
TriangulatedSurface<Real> make_surface(Triangulation wanted, const Making& making,
                                       TriangulationReport& report);

}  // namespace plexway
