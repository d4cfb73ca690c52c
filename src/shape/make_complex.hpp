#pragma once

#include <array>
#include <cstddef>
#include <functional>
#include <span>
#include <vector>

#include <plexway/common/mask.hpp>
#include <plexway/common/rows_of.hpp>
#include <plexway/domain/domains.hpp>
#include <plexway/mixed/mixed_complex.hpp>
#include <plexway/shape/field.hpp>
#include <plexway/shape/shape.hpp>
#include <plexway/surface/intrinsic_delaunay.hpp>

namespace plexway::detail {

constexpr Triangulation named(Retriangulation done) {
  return done == Retriangulation::keep    ? Triangulation::input
         : done == Retriangulation::flips ? Triangulation::delaunay
                                          : Triangulation::refined;
}

/// What a complex is made of.
struct Making {
  const AnyShape& shape;
  const MeasuredLengths* lengths = nullptr;  ///< by a metric, or those alone; null: in space
  const Mask* mask = nullptr;                ///< null: all is open
  int threads = 0;                           ///< 0: all
  std::function<bool(double)> progress = {};

  /// Those of the shape that are open.
  template <std::size_t N>
  [[nodiscard]] GivenSimplices<N> open(const std::vector<std::array<Index, N>>& simplices) const {
    if (mask == nullptr) return simplices;
    return mask->open(simplices);
  }
  /// What belongs to them.
  template <std::size_t N, class Row>
  [[nodiscard]] Given<Row> open(const std::vector<std::array<Index, N>>& simplices,
                                const std::vector<Row>& rows) const {
    if (mask == nullptr) return rows;
    return mask->open_rows(std::span<const std::array<Index, N>>(simplices), rows);
  }
};

// The complex of each kind of shape. Each is built in place: complexes are not to be copied.
template <class Real>
TriangleMesh<Real> make_complex(const io::Triangles& surface, const Making& making) {
  const auto open = making.open(surface.triangles);
  SurfaceHints hints;
  hints.threads = making.threads;
  if (making.lengths == nullptr) return {surface.positions, open, hints};
  hints.refracts = making.lengths->refracts;
  return {making.shape.vertices(), open, making.open(surface.triangles, making.lengths->triangles),
          hints};
}
template <class Real>
TetMesh<Real> make_complex(const io::Tets& solid, const Making& making) {
  const auto open = making.open(solid.tets);
  if (making.lengths == nullptr) return {solid.positions, open, making.threads};
  return {making.shape.vertices(), open, making.open(solid.tets, making.lengths->tets),
          making.threads};
}
template <class Real>
Wireframe<Real> make_complex(const io::Edges& wireframe, const Making& making) {
  const auto open = making.open(wireframe.edges);
  if (making.lengths == nullptr && wireframe.lengths.empty() && !wireframe.positions.empty())
    return {wireframe.positions, open};
  return {wireframe.vertices, open,
          making.open(wireframe.edges,
                      making.lengths != nullptr ? making.lengths->edges : wireframe.lengths)};
}
template <class Real>
PointCloud<Real> make_complex(const CloudShape& cloud, const Making& making) {
  CloudOptions options;
  if (cloud.max_normal_angle) options.max_normal_angle = *cloud.max_normal_angle;
  options.normals = cloud.normals();
  options.threads = making.threads;
  options.progress = making.progress;
  return {cloud.measured(), cloud.neighbours, options};
}

/// A surface on the triangles wanted, or if that is left open on those that pay; what comes with it
/// translates points.
template <class Real>
TriangulatedSurface<Real> make_surface(Triangulation wanted, const Making& making,
                                       TriangulationReport& report);

/// A mixed shape as pieces of one dimension and one speed each, welded where they share vertices.
template <class Real>
struct MixedPieces {
  /// `speeds` are one a simplex, or none: 1 for all.
  explicit MixedPieces(const MixedShape& shape, std::span<const double> speeds = {});

  MixedComplex<Real> complex;
  std::vector<Index> vertex;   ///< of each of the shape's vertices, one of the complex; or none
  std::vector<Index> simplex;  ///< likewise
};

}  // namespace plexway::detail
